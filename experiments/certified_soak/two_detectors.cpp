// SPDX-License-Identifier: GPL-3.0-or-later
#include "certified_soak/two_detectors.h"

#include <algorithm>
#include <limits>

namespace lodestone {

namespace {

constexpr std::size_t all_of_them = std::numeric_limits<std::size_t>::max();

Detector_options in_mode(Mode mode, Detector_options options) {
  options.mode = mode;
  if (mode == Mode::exact) {
    options.contacts = Contact_query::all;
    options.most_contacts = all_of_them;
    options.exact.throw_if_broken = false;
  }
  return options;
}

Pair_result result_of(const Frame& frame, Object_pair objects) {
  for (const auto& pair : frame.pairs)
    if (pair.a == objects.a && pair.b == objects.b) return pair;
  return {.a = objects.a, .b = objects.b};
}

/// What both modes must agree on, whichever contacts they list.
bool same_pair(const Pair_result& found, const Pair_result& truth) {
  const bool parted = found.parting.has_value() == truth.parting.has_value() &&
                      (!found.parting || found.parting->translation == truth.parting->translation);
  return found.collides == truth.collides && found.near == truth.near && found.containment == truth.containment &&
         parted;
}

/// Contacts of a pair that a frame lists.
std::size_t most_listed(const Detector_options& options) {
  if (options.contacts == Contact_query::yes_no) return 0;
  return options.contacts == Contact_query::first ? 1 : options.most_contacts;
}

}  // namespace

bool is_right(const Frame& found, const Frame& truth, Object_pair pair, const Detector_options& asked) {
  const Pair_result one = result_of(found, pair), other = result_of(truth, pair);
  if (!same_pair(one, other)) return false;
  const auto listed = found.contacts(one), all = truth.contacts(other);
  const std::size_t most = most_listed(asked);
  if (asked.contacts == Contact_query::all && one.capped != (all.size() > most)) return false;
  return listed.size() == std::min(all.size(), most) && std::ranges::includes(all, listed);
}

Two_detectors::Two_detectors(const Detector_options& options)
    : asked_(options), certified_(in_mode(Mode::certified, options)), exact_(in_mode(Mode::exact, options)) {}

void Two_detectors::add(const Random_body& body) {
  body.add_to(exact_);
  body.promise_to(certified_, body.add_to(certified_));
  ++count_;
}

Two_detectors::Frame_check Two_detectors::detect() {
  const Frame& truth = exact_.detect();
  const Frame& found = certified_.detect();
  Frame_check check{.meets_first = std::vector<bool>(count_)};
  for (Object_id a = 0; a < count_; ++a)
    for (Object_id b = a; b < count_; ++b) {
      check.same &= is_right(found, truth, {a, b}, asked_);
      const bool collide = a != b && result_of(truth, {a, b}).collides;
      check.collides |= collide;
      if (a == 0) check.meets_first[b] = collide;
    }
  if (asked_.contacts == Contact_query::all && most_listed(asked_) == all_of_them)
    check.same &= found.face_pairs == truth.face_pairs && found.contact_points == truth.contact_points &&
                  found.patches.size() == truth.patches.size();
  return check;
}

std::size_t Two_detectors::violations() const {
  std::size_t sum = 0;
  for (Object_id id = 0; id < count_; ++id)
    if (const Bounded_surface* surface = certified_.bounded(id)) sum += surface->violations();
  return sum;
}

}  // namespace lodestone
