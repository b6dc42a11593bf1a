// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/meeting_search.h"

#include <algorithm>
#include <functional>
#include <optional>

namespace lodestone {

void Meeting_search::start_frame() {
  memory_.start_frame();
  curves_.start_frame();
  for (Pair_search& search : searches_) search.start_frame();
}

/// Fewer pairs are over before other threads have been woken: mostly a pair takes some microseconds, and several times
/// as much for all contacts.
bool Meeting_search::are_worth_sharing(std::size_t pairs) const {
  return workers_.count() > 1 && pairs >= (wants_all() ? 8 : 32);
}

void Meeting_search::look(std::span<Met_pair> pairs) {
  if (are_worth_sharing(pairs.size())) {
    while (searches_.size() < workers_.count()) searches_.emplace_back(options_, memory_, curves_);
    ids_.clear();
    for (const Met_pair& pair : pairs) ids_.push_back(pair.ids);
    levels_.assign(ids_);
  }
  for_each(pairs, [](Pair_search& search, Met_pair& pair, Workers& workers) { search.look(pair, workers); });
}

void Meeting_search::follow_shared_curves(std::span<Met_pair> pairs) {
  if (!wants_all() || !are_worth_sharing(pairs.size())) return;
  for_each(pairs, [](Pair_search& search, Met_pair& pair, Workers& workers) { search.follow_curves(pair, workers); });
}

/// Takes a step of each pair: in the order of the list, or level by level.
template <class Step>
void Meeting_search::for_each(std::span<Met_pair> pairs, const Step& step) {
  if (are_worth_sharing(pairs.size())) {
    for (std::size_t level = 0; level < levels_.size(); ++level) share_level(levels_.level(level), pairs, step);
  } else {
    for (Met_pair& pair : pairs) step(searches_.front(), pair, workers_);
  }
}

/// Takes a step of each pair of a level. What a mesh computes when it is read, only this thread may read. Where a level
/// has few pairs, the workers share the faces of each: one of the pairs may take longer than all others.
template <class Step>
void Meeting_search::share_level(std::span<const std::uint32_t> level, std::span<Met_pair> pairs, const Step& step) {
  shared_.clear();
  for (const std::uint32_t pair : level)
    if (pairs[pair].is_shared()) shared_.push_back(pair);
  const std::size_t fewest = wants_all() ? 8 : 16;
  if (shared_.size() < std::max(fewest, 2 * workers_.count())) shared_.clear();
  const auto step_of = [&](std::size_t i, std::size_t worker) {
    step(searches_[worker], pairs[shared_[i]], Workers::alone());
  };
  workers_.run(shared_.size(), std::cref(step_of));
  for (const std::uint32_t pair : level)
    if (shared_.empty() || !pairs[pair].is_shared()) step(searches_.front(), pairs[pair], workers_);
}

void Meeting_search::report(Met_pair& pair, std::vector<Face_pair>& found) {
  if (pair.seeds().empty()) return;
  if (wants_all()) {
    if (pair.followed_in == nullptr) searches_.front().follow_curves_alone(pair, workers_);
    found.insert(found.end(), pair.contacts_of_curves().begin(), pair.contacts_of_curves().end());
    remember_some(pair);
    if (pair.limited) remember_curves(pair);
  } else {
    found.push_back(pair.seeds().front().contact);
    remember_one(pair);
  }
}

/// Remembers contacts at equal steps in the list of all.
void Meeting_search::remember_some(const Met_pair& pair) {
  const auto contacts = pair.contacts_of_curves();
  const std::size_t step = contacts.size() / options_.meetings + (contacts.size() % options_.meetings > 0 ? 1 : 0);
  for (std::size_t i = 0; i < contacts.size(); i += step) memory_.keep(pair.ids, met_at(pair, contacts[i]));
}

/// Remembers a contact in each pair of leaves that has any. Those of one pair mostly follow each other in the list.
void Meeting_search::remember_curves(const Met_pair& pair) {
  const Leaf_neighbours &a = pair.a->leaf_neighbours(), &b = pair.b->leaf_neighbours();
  std::optional<Leaf_pair> last;
  for (const Face_pair contact : pair.contacts_of_curves())
    if (const Leaf_pair leaves{a.leaf_of(contact.a), b.leaf_of(contact.b)}; leaves != last) {
      curves_.keep(pair.ids, contact);
      last = leaves;
    }
}

/// Remembers the contact that was found, and the meetings of the last frame: one of them may be of use once this one
/// parts.
void Meeting_search::remember_one(const Met_pair& pair) {
  const Remembered_meeting& found = pair.seeds().front();
  memory_.keep(pair.ids, found);
  std::size_t kept = 1;
  for (const auto& meeting : memory_.recall(pair.ids))
    if (meeting.contact != found.contact && kept++ < options_.meetings) memory_.keep(pair.ids, meeting);
}

Meeting_counts Meeting_search::counts() const {
  Meeting_counts sum;
  for (const Pair_search& search : searches_) {
    const Meeting_counts counts = search.counts();
    sum.meetings += counts.meetings;
    sum.leaf_tests += counts.leaf_tests;
    sum.exact_tests += counts.exact_tests;
    sum.vertices_read += counts.vertices_read;
  }
  return sum;
}

}  // namespace lodestone
