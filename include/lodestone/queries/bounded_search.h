// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "lodestone/bounds/bounded_surface.h"
#include "lodestone/filter/face_filter.h"
#include "lodestone/mesh/pairs.h"
#include "lodestone/queries/contact_search.h"
#include "lodestone/queries/leaf_pair_list.h"
#include "lodestone/tree/node_pair.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

/// Finds the contacts of two surfaces without posing what is far: nodes are compared by their bounds, from the roots
/// down or from two leaves outwards; the leaves that may meet are posed, and their faces tested exactly.
///
/// The contacts are those of a Contact_search over all positions. Where a position is found outside its bound, its
/// surface is posed as a whole and the search begins anew; a bound that is broken elsewhere goes unnoticed. Once both
/// surfaces are posed as a whole, a Contact_search goes on, and shares the work among workers.
///
/// Keeps its memory from one search to the next.
class Bounded_search {
 public:
  /// @param workers  must outlive this
  explicit Bounded_search(Workers& workers = Workers::alone()) : whole_(workers) {}

  /// Finds the contacts of two surfaces.
  /// @param a, b   two surfaces
  /// @param found  contacts are appended, sorted; none for the query `yes_no`
  /// @param place  for the query `yes_no`: two leaves where an earlier search found a contact, or none; null: the
  ///               search begins at the roots. It begins at these leaves. Where surfaces move little from one pose to
  ///               the next, it often ends there too. Any leaves will do, also such as do not exist. The search sets
  ///               them to where it has found a contact, or to none if there is none. It leaves them as they are if
  ///               all was posed, so that it did not look at single leaves, and there is a contact
  /// @throws Bad_argument  the tolerance is not finite or below 0
  /// @throws Bad_mesh      a coordinate that is read is not finite
  Contact_summary run(Bounded_surface& a, Bounded_surface& b, const Contact_request& request,
                      std::vector<Face_pair>& found, std::optional<Leaf_pair>* place = nullptr);
  /// Shows each contact once to a visitor, until it stops the walk.
  /// @param tolerance  as of a request
  /// @throws Bad_argument, Bad_mesh  as `run`
  Visit visit(Bounded_surface& a, Bounded_surface& b, double tolerance, const std::function<Visit(Face_pair)>& visitor);

 private:
  enum class End { complete, stopped, broken, all_posed };

  void begin(Bounded_surface& a, Bounded_surface& b, double tolerance, bool is_ordered);
  void start_at(const std::optional<Leaf_pair>& place);
  template <class Visitor>
  End walk(bool until_all_posed, Visitor&& visitor);
  void open(Node_pair pair);
  double overlap_depth(Node_pair pair);
  bool are_near(Node_pair pair) { return near(a_->box(pair.a), b_->box(pair.b), tolerance_); }
  template <class Visitor>
  End test_leaves(Node_pair pair, Visitor& visitor);
  void begin_filter();
  bool is_broken() const { return a_->is_broken() || b_->is_broken(); }
  bool all_posed() const { return a_->all_posed() && b_->all_posed(); }
  void settle_broken();

  Bounded_surface* a_ = nullptr;
  Bounded_surface* b_ = nullptr;
  double tolerance_ = 0;
  bool is_ordered_ = false;         ///< pairs that lie deeper are visited first
  std::vector<Node_pair> starts_;   ///< of a walk, in order: below them lies each pair of leaves once
  std::vector<Node_pair> waiting_;  ///< still to be visited; near when listed, except where a walk starts
  Leaf_pair tested_ = {};           ///< last
  Face_filter filter_;
  Coordinates filter_of_a_ = {}, filter_of_b_ = {};  ///< which positions the filter has been told of; empty: none
  std::size_t leaf_tests_ = 0, exact_tests_ = 0;
  Contact_search whole_;
  Task_contacts contacts_;
};

}  // namespace lodestone
