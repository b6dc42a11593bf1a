// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lodestone/filter/face_filter.h"
#include "lodestone/mesh/pairs.h"
#include "lodestone/tree/node_pair.h"
#include "lodestone/tree/tree_on_demand.h"

namespace lodestone {

/// What a search by openings is to find, and at what price.
struct Opening_request {
  bool all = false;  ///< every contact that can be found; false: one
  double reach = 1;  ///< c, the dial between guess and proof: two nodes are taken to be apart if their anchors are
                     ///< farther apart than c (rho_a + rho_b)
  std::size_t budget = 0;  ///< most vertices to read in both trees together
};

/// Searches two surfaces for contacts from coarse to fine: pairs of nodes are opened in the order of how near their
/// anchors are, relative to their radii; the faces of leaves are tested exactly. The order matters only where the
/// budget may end the search: two surfaces that it covers as a whole are searched in the order that is fastest.
///
/// What is found is true. Contacts are missed where a surface is stretched beyond its radii, with c below 1, and once
/// the budget is used up. Reads one vertex per node that it looks at, and the vertices of the leaves that it compares.
///
/// Keeps its memory from one search to the next.
class Opening_search {
 public:
  /// Starts a search of two trees.
  void begin(Tree_on_demand& a, Tree_on_demand& b, const Opening_request& request);
  /// Adds two nodes below which to search.
  /// @param order  squared distance of their anchors, relative to the sum of their radii
  void add_start(Node_pair nodes, float order) { waiting_.push_back({order, nodes}); }

  /// Tests the faces of two leaves, and appends their contacts to `found`; one, unless all are asked for.
  /// @return whether there was one
  bool test_leaves(std::uint32_t leaf_a, std::uint32_t leaf_b, std::vector<Face_pair>& found);

  /// Opens the pairs that were added, and what is below, until there is no more to find, or the budget is used up.
  /// @return whether a contact was found
  bool open(std::vector<Face_pair>& found);

  /// Whether the last `open` ended because its budget was used up.
  bool out_of_budget() const { return out_of_budget_; }
  /// Leaf pairs tested since `begin`.
  std::size_t leaf_tests() const { return leaf_tests_; }
  /// Face pairs given to exact predicates since `begin`.
  std::size_t exact_tests() const { return exact_tests_; }

 private:
  /// A pair of nodes that may meet.
  struct Opening {
    float order;  ///< see `add_start`
    Node_pair nodes;
  };

  void open_in_order(std::vector<Face_pair>& found);
  void open_depth_first(std::vector<Face_pair>& found);
  bool is_leaf_pair(Node_pair pair) const;
  bool test_leaf_pair(Node_pair pair, std::vector<Face_pair>& found);
  bool is_apart(const Aabb& box, Tree_on_demand& tree, std::uint32_t node) const;
  std::size_t vertices_read() const { return a_->vertices_read() + b_->vertices_read(); }
  void consider(Node_pair pair);
  void consider_children(Node_pair pair);
  void begin_filter();

  Tree_on_demand* a_ = nullptr;
  Tree_on_demand* b_ = nullptr;
  Opening_request request_;
  std::vector<Opening> waiting_;  ///< a heap, the next to be opened first; or a stack
  Face_filter filter_;
  Aabb bounds_a_ = {}, bounds_b_ = {};  ///< what the filter has been told
  bool filter_begun_ = false;
  bool out_of_budget_ = false;
  std::size_t leaf_tests_ = 0, exact_tests_ = 0;
};

}  // namespace lodestone
