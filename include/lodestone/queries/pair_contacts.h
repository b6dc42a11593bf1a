// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/pairs.h"
#include "lodestone/queries/contact_search.h"

namespace lodestone {

/// Whether the objects of a pair collide, and what it took to find out.
struct Pair_contacts {
  bool collides = false;        ///< two faces intersect
  bool near = false;            ///< a tolerance is given, and two faces are nearer
  bool capped = false;          ///< there are more contacts than `Contact_request::most`
  std::size_t leaf_tests = 0;   ///< leaf pairs tested
  std::size_t exact_tests = 0;  ///< face pairs given to exact predicates
};

/// Puts contacts in the place of others: as many are listed as before, sorted.
/// @param preferred  sorted, no more than are listed
/// @param found      from `begin` on sorted
void prefer(std::span<const Face_pair> preferred, std::vector<Face_pair>& found, std::size_t begin);

/// Whether each contact is one of those that intersect: 1 or 0.
/// @param intersecting  sorted
/// @param found         from `begin` on sorted
/// @param intersects    parallel to `found`; written from `begin` on
void tell_which_intersect(std::span<const Face_pair> intersecting, std::span<const Face_pair> found, std::size_t begin,
                          std::vector<std::uint8_t>& intersects);

/// Searches for the contacts of a pair. What is near may collide or not, and a near contact intersect or not: a second
/// search without the tolerance tells. Where not all contacts are listed, those that intersect come before those that
/// are only near.
/// @param search      called with a Contact_request and a list of contacts to append to; gives a Contact_summary
/// @param found       the contacts are appended, sorted; none for the query `yes_no`
/// @param intersects  with a tolerance, parallel to `found`: whether the faces of a contact intersect, appended
template <class Search>
Pair_contacts pair_contacts(const Contact_request& request, const Search& search, std::vector<Face_pair>& found,
                            std::vector<std::uint8_t>& intersects) {
  const bool with_tolerance = request.tolerance > 0;
  const std::size_t begin = found.size();
  const Contact_summary contacts = search(request, found);
  Pair_contacts result{.collides = contacts.found,
                       .near = with_tolerance && contacts.found,
                       .capped = contacts.capped,
                       .leaf_tests = contacts.leaf_tests,
                       .exact_tests = contacts.exact_tests};
  if (!result.near) return result;
  std::vector<Face_pair> intersecting;
  const Contact_summary collision = search({.query = request.query, .most = request.most}, intersecting);
  prefer(intersecting, found, begin);
  tell_which_intersect(intersecting, found, begin, intersects);
  result.collides = collision.found;
  result.leaf_tests += collision.leaf_tests;
  result.exact_tests += collision.exact_tests;
  return result;
}

}  // namespace lodestone
