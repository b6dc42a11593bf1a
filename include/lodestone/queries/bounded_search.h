// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "lodestone/bounds/bounded_surface.h"
#include "lodestone/filter/face_filter.h"
#include "lodestone/mesh/pairs.h"
#include "lodestone/queries/contact_search.h"
#include "lodestone/tree/node_pair.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

/// Finds the contacts of two surfaces without posing what is far: nodes are compared by their bounds, from the roots
/// down; the leaves that may meet are posed, and their faces tested exactly.
///
/// The contacts are those of a Contact_search over all positions. Where a position is found outside its bound, its
/// surface is posed as a whole and the search begins anew; a bound that is broken elsewhere goes unnoticed.
///
/// Keeps its memory from one search to the next.
class Bounded_search {
 public:
  /// @param a, b       two surfaces
  /// @param found      contacts are appended, sorted; one at most unless all are asked for, none for `yes_no`
  /// @param tolerance  distance below which two faces are a contact, in units of the coordinates; >= 0; 0: they must
  ///                   intersect
  /// @throws Bad_argument  the tolerance is not finite or below 0
  /// @throws Bad_mesh      a coordinate that is read is not finite
  Contact_summary run(Bounded_surface& a, Bounded_surface& b, Contact_query query, std::vector<Face_pair>& found,
                      double tolerance = 0);

 private:
  bool search(std::vector<Face_pair>& found);
  bool test_leaves(std::uint32_t leaf_a, std::uint32_t leaf_b, std::vector<Face_pair>& found);
  bool are_in_contact(const Triangle_corners& a, const Triangle_corners& b, Crossing likely) const;
  bool is_broken() const { return a_->is_broken() || b_->is_broken(); }

  Bounded_surface* a_ = nullptr;
  Bounded_surface* b_ = nullptr;
  bool one_is_enough_ = false;
  double tolerance_ = 0;
  std::vector<Node_pair> waiting_;
  Face_filter filter_;
  bool filter_begun_ = false;
  std::size_t leaf_tests_ = 0, exact_tests_ = 0;
};

}  // namespace lodestone
