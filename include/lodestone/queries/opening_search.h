// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lodestone/filter/face_filter.h"
#include "lodestone/mesh/pairs.h"
#include "lodestone/mesh/workers.h"
#include "lodestone/queries/leaf_pair_list.h"
#include "lodestone/queries/opening_starts.h"
#include "lodestone/tree/leaf_neighbours.h"
#include "lodestone/tree/node_pair.h"
#include "lodestone/tree/tree_on_demand.h"

namespace lodestone {

/// What a search by openings is to find, and at what price.
struct Opening_request {
  bool all = false;  ///< every contact that can be found; false: one
  double reach = 1;  ///< c, the dial between guess and proof: two nodes are taken to be apart if their anchors are
                     ///< farther apart than c (rho_a + rho_b)
  std::size_t budget = 0;      ///< how many vertices of both trees together openings may read, less those that `follow`
                               ///< has read before; but at least half of it. Four pairs of nodes that are compared
                               ///< count as one. `follow` has no limit.
  std::size_t most_whole = 0;  ///< vertices of both trees below the starts up to which they are read as a whole
  bool opened = false;         ///< for `follow` alone: a search for all, with equal requests but for this, has opened
                               ///< the same starts in this frame
};

/// From where `Opening_search::follow` starts.
struct Curve_starts {
  /// Must hold all contacts of the leaf pairs in `compared`, and all below starts that were `opened` and are read as a
  /// whole. Of further contacts the leaves are compared.
  std::span<const Face_pair> contacts;
  /// Leaf pairs that are not compared again.
  std::span<const Leaf_pair> compared = {};
  /// The first so many contacts were found by `follow` in this frame, and all that it compared is in `compared`.
  std::size_t followed = 0;
};

/// Searches two surfaces for contacts below pairs of nodes, in one of two ways. If the leaves below these nodes have no
/// more vertices than `most_whole`, they are read as a whole, and the boxes of nodes tell which leaves may meet.
/// Otherwise pairs of nodes are opened from coarse to fine, in the order of how near their anchors are, relative to
/// their radii, to within a 64th, until the budget is used up. Beside a much larger leaf, such as a wall, it is the
/// distance from its faces that counts. Two surfaces that the budget covers are searched to the end, in the order that
/// is fastest. Openings read one vertex per node that they look at, and the vertices of the leaves that they compare.
/// In both ways the faces of leaves are tested exactly. One contact is searched for by openings first, which may find
/// it soon; once these have read half of both surfaces, the nodes are read as a whole, if `most_whole` allows it.
///
/// What is found is true. Below nodes that are read as a whole nothing is missed. Otherwise contacts are missed once
/// the budget is used up, where a surface is stretched beyond its radii, and with c below 1.
///
/// Keeps its memory from one search to the next.
class Opening_search {
 public:
  /// Starts a search of two trees below some pairs of nodes. Costs what `Opening_starts::begin` does.
  void begin(Tree_on_demand& a, Tree_on_demand& b, const Opening_request& request,
             std::span<const Opening_start> starts = {});

  /// Opens the pairs of nodes, and what is below, until there is no more to find, or the budget is used up.
  /// Appends the contacts to `found`; one, unless all are asked for. For all, the workers share the tests of faces, and
  /// leaf pairs that `follow` has compared are left out.
  /// @return whether a contact was found
  /// @throws Bad_mesh  a coordinate that is read is not finite
  bool open(std::vector<Face_pair>& found, Workers& workers = Workers::alone());

  /// Follows the curves of intersection on which contacts lie, after `begin` for all contacts, before or without
  /// `open`. Compares the leaves of each contact, and the leaves beside it where it lies at their border. Given what an
  /// earlier search has compared and found, it finds what that left: where the budget ended it, or a surface is
  /// stretched beyond its radii. The workers share the tests.
  /// @param a, b    neighbours of the leaves of the two trees
  /// @param starts  no view of `compared()` or of `found`, which change
  /// @param found   all contacts of the curves, and of the leaves on them, are appended, each once
  /// @throws Bad_mesh  a coordinate that is read is not finite
  void follow(Leaf_neighbours& a, Leaf_neighbours& b, const Curve_starts& starts, std::vector<Face_pair>& found,
              Workers& workers = Workers::alone());

  /// Whether the budget may end the search: nodes are opened, and the two surfaces have more vertices.
  bool is_limited() const { return !whole_ && in_order_; }
  /// What has been spent of the budget since `begin`, in vertices of both trees.
  std::size_t spent() const;
  /// Whether the last `open` ended because its budget was used up.
  bool out_of_budget() const { return out_of_budget_; }
  /// Leaf pairs that need not be compared again: those given to `follow`, those that it has looked at, and those that
  /// `open` for all contacts has tested since; each once.
  std::span<const Leaf_pair> compared() const { return compared_.pairs(); }
  /// Leaf pairs tested since `begin`.
  std::size_t leaf_tests() const { return leaf_tests_; }
  /// Face pairs given to exact predicates since `begin`.
  std::size_t exact_tests() const { return exact_tests_; }

 private:
  /// Pairs of nodes that wait to be opened, in stacks of nearly one order each. The order is the squared distance of
  /// two nodes relative to their radii: 0 .. 1 where these reach each other, more where only a larger reach does.
  class Waiting {
   public:
    void clear();
    bool empty() const { return (filled_[0] | filled_[1]) == 0; }
    void push(Node_pair nodes, double order);
    /// Takes a pair of the lowest order: of several the one that was pushed last.
    Node_pair pop();

   private:
    using Stacks = std::array<std::vector<Node_pair>, 64>;

    std::array<Stacks, 2> stacks_;              ///< of orders up to 1, and of those beyond
    std::array<std::uint64_t, 2> filled_ = {};  ///< a bit per stack
  };
  /// What the tests of some leaf pairs have found.
  struct Tested {
    std::vector<Face_pair> found;
    std::size_t exact_tests = 0;
  };

  bool may_read_whole();
  void begin_openings();
  void begin_whole();
  void pose_starts();
  bool was_opened(Leaf_pair leaves) const { return request_.opened && starts_.cover(leaves); }
  bool next(Leaf_pair& leaves) { return whole_ ? next_by_boxes(leaves) : next_by_anchors(leaves); }
  bool next_by_anchors(Leaf_pair& leaves);
  bool next_by_boxes(Leaf_pair& leaves);
  bool near_leaves(Leaf_pair leaves);
  static bool is_apart(const Aabb& box, Tree_on_demand& tree, std::uint32_t node, double reach);
  void consider(Node_pair pair);
  std::optional<double> order_beside(Tree_on_demand& tree, std::uint32_t leaf, Tree_on_demand& other,
                                     std::uint32_t node);
  void consider_children(Node_pair pair);
  void push_if_near(Node_pair pair);
  void open_for_one(std::vector<Face_pair>& found);
  bool find_one(std::vector<Face_pair>& found);
  void open_for_all(std::vector<Face_pair>& found, Workers& workers);
  void follow_contact(Leaf_neighbours& a, Leaf_neighbours& b, Face_pair contact);
  void compare_beside(std::vector<Face_pair>& found, Workers& workers);
  void begin_filters(std::size_t count);
  void test(Leaf_pair leaves, Face_filter& filter, Tested& tested) const;
  void test_listed(std::vector<Face_pair>& found, Workers& workers);

  Tree_on_demand* a_ = nullptr;
  Tree_on_demand* b_ = nullptr;
  Opening_request request_;
  std::vector<Opening_start> given_starts_;
  Opening_starts starts_;  ///< the same, once it is known whether they may be read as a whole
  bool whole_ = false;     ///< they are read as a whole
  bool in_order_ = false;  ///< the nearest first, since the budget covers less than both surfaces
  Waiting waiting_;
  std::size_t considered_ = 0;     ///< pairs of nodes whose anchors were compared
  std::size_t read_before_ = 0;    ///< vertices of both trees, before `begin`
  std::size_t limit_ = 0;          ///< of what is spent
  std::vector<Leaf_pair> listed_;  ///< to be tested
  std::vector<Tested> tested_;     ///< per task, then memory of earlier searches
  Leaf_pair_list compared_;        ///< see `compared`
  std::vector<Leaf_pair> opened_;  ///< for one contact: tested by openings; sorted before regions are read as a whole
  std::vector<Leaf_pair> beside_;  ///< to be compared, unless they have been
  std::vector<Face_filter> filters_;    ///< per worker
  Aabb bounds_a_ = {}, bounds_b_ = {};  ///< what the filters have been told
  std::size_t begun_ = 0;               ///< filters that have been told
  bool out_of_budget_ = false;
  std::size_t leaf_tests_ = 0, exact_tests_ = 0;
};

}  // namespace lodestone
