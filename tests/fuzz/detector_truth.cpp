// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/detector_truth.h"

#include <algorithm>
#include <string>

#include "lodestone/triangles/neighbour_check.h"
#include "lodestone/triangles/triangle_distance.h"

namespace lodestone::fuzz {

namespace {

std::vector<Face_pair> contacts_within(const Drawn_object& object) {
  std::vector<Face_pair> found;
  for (std::uint32_t f = 0; f < object.faces.size(); ++f)
    for (std::uint32_t g = f + 1; g < object.faces.size(); ++g)
      if (faces_intersect(object.faces[f], object.triangle(f), object.faces[g], object.triangle(g)))
        found.push_back({f, g});
  return found;
}

std::string text_of(const std::vector<Face_pair>& pairs) {
  std::string text = std::to_string(pairs.size()) + ":";
  for (std::size_t i = 0; i < std::min<std::size_t>(pairs.size(), 20); ++i)
    text.append(" ").append(std::to_string(pairs[i].a)).append("-").append(std::to_string(pairs[i].b));
  return text;
}

/// The contacts that a frame lists are the truth, as far as it was asked for.
void check_contacts(const std::vector<Face_pair>& listed, const std::vector<Face_pair>& truth,
                    const Pair_result& result, const Detector_options& options, const std::string& where) {
  const std::string both = where + ": listed " + text_of(listed) + ", truth " + text_of(truth);
  require(std::ranges::is_sorted(listed), "contacts are not in order, " + both);
  require(std::ranges::includes(truth, listed), "a contact is not true, " + both);
  if (!finds_all(options.mode)) return;
  std::size_t expected = truth.size();
  if (options.contacts == Contact_query::yes_no) expected = 0;
  if (options.contacts == Contact_query::first) expected = std::min<std::size_t>(expected, 1);
  require(listed.size() == std::min(expected, options.most_contacts), "another number of contacts, " + both);
  if (options.contacts == Contact_query::all)
    require(result.capped == (expected > options.most_contacts), "capped is wrong, " + both);
}

void check_answers(const Pair_result& result, bool truly_near, bool truly_collide, const Detector_options& options,
                   const std::string& where) {
  const bool finds = finds_all(options.mode);
  require(result.collides ? truly_collide : !(finds && truly_collide), "collides is wrong, " + where);
  if (finds && result.a != result.b && options.exact.tolerance > 0)
    require(result.near == truly_near, "near is wrong, " + where);
}

}  // namespace

std::vector<Face_pair> true_contacts(const Drawn_object& a, const Drawn_object& b, double distance) {
  if (&a == &b) return contacts_within(a);
  std::vector<Face_pair> found;
  for (std::uint32_t f = 0; f < a.faces.size(); ++f) {
    const Triangle triangle = a.triangle(f);
    for (std::uint32_t g = 0; g < b.faces.size(); ++g)
      if (distance > 0 ? triangles_nearer_than(triangle, b.triangle(g), distance)
                       : triangles_intersect(triangle, b.triangle(g)))
        found.push_back({f, g});
  }
  return found;
}

void check_pair(const Frame& frame, const Detector_options& options, Object_pair ids, const Drawn_object& a,
                const Drawn_object& b, bool is_allowed) {
  const std::string where = "objects " + std::to_string(ids.a) + " and " + std::to_string(ids.b);
  const auto result =
      std::ranges::find_if(frame.pairs, [&](const auto& pair) { return pair.a == ids.a && pair.b == ids.b; });
  if (result == frame.pairs.end()) {
    if (!is_allowed || !finds_all(options.mode)) return;
    const auto truth = true_contacts(a, b, options.exact.tolerance);
    require(truth.empty(), where + ": not listed, truth " + text_of(truth));
    return;
  }
  require(is_allowed, where + ": listed, though left out");
  const auto truth = true_contacts(a, b, options.exact.tolerance);
  const bool collide = options.exact.tolerance > 0 ? !true_contacts(a, b, 0).empty() : !truth.empty();
  const auto contacts = frame.contacts(*result);
  check_contacts({contacts.begin(), contacts.end()}, truth, *result, options, where);
  check_answers(*result, !truth.empty(), collide, options, where);
}

void check_lists(const Frame& frame, const Detector_options& options) {
  require(std::ranges::is_sorted(frame.pairs, {},
                                 [](const auto& pair) {
                                   return Object_pair{pair.a, pair.b};
                                 }),
          "the pairs of a frame are not in order");
  std::size_t contacts = 0;
  for (const auto& pair : frame.pairs) {
    require(pair.first_contact == contacts, "the contacts of a pair begin elsewhere");
    contacts += pair.contacts;
  }
  require(contacts == frame.face_pairs.size(), "pairs and contacts do not fit");
  const bool points = options.contact_points || options.exact.patches;
  const bool normals = options.contact_normals || options.exact.patches;
  require(frame.contact_points.size() == (points ? contacts : 0), "contact points do not fit the contacts");
  require(frame.contact_normals.size() == (normals ? contacts : 0), "contact normals do not fit the contacts");
  for (const auto& places : frame.contact_points) require(!places.empty(), "a contact has no point");
}

}  // namespace lodestone::fuzz
