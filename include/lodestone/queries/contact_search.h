// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "lodestone/mesh/pairs.h"
#include "lodestone/mesh/workers.h"
#include "lodestone/queries/visit_contacts.h"
#include "lodestone/tree/tree_surface.h"
#include "lodestone/triangles/neighbour_check.h"

namespace lodestone {

struct Contact_request {
  Contact_query query = Contact_query::all;
  double tolerance = 0;                                        ///< see `visit_contacts`; >= 0
  std::size_t most = std::numeric_limits<std::size_t>::max();  ///< of the face pairs listed; >= 1
};

/// What a search found. All of it is the same for any number of workers.
struct Contact_summary {
  bool found = false;
  bool capped = false;          ///< there are more face pairs than `Contact_request::most`
  std::size_t leaf_tests = 0;   ///< pairs of leaves looked at
  std::size_t exact_tests = 0;  ///< face pairs given to exact predicates
};

/// Finds the face pairs of trees that intersect, or are near. Holds the memory that it needs.
class Contact_search {
 public:
  explicit Contact_search(Workers& workers);

  /// Adds the face pairs of two objects to `found`, sorted; none for the query `yes_no`.
  template <Bounding_volume Volume>
  Contact_summary between(const Basic_tree_surface<Volume>& a, const Basic_tree_surface<Volume>& b,
                          const Contact_request& request, std::vector<Face_pair>& found);
  /// Adds the intersecting pairs of faces of one object, a < b, those that share vertices included: see
  /// `faces_intersect`. The tolerance does not count: neighbours are always near.
  template <Bounding_volume Volume>
  Contact_summary within(const Basic_tree_surface<Volume>& object, const Contact_request& request,
                         std::vector<Face_pair>& found);

 private:
  /// What one worker keeps.
  struct Scratch {
    Tree_walk walk;
    Neighbour_check neighbours;
  };
  /// What one task found.
  struct Result {
    std::vector<Face_pair> found;
    std::size_t leaf_tests = 0;
    std::size_t exact_tests = 0;
  };
  /// Adds to a result until it holds `limit` face pairs.
  using Task = std::function<void(std::size_t limit, Scratch& scratch, Result& result)>;
  /// What a search consists of.
  struct Plan {
    std::size_t leaves;  ///< of the trees
    Task walk;           ///< goes on from `scratch.walk.ahead`
    /// Replaces a node pair by those below it, the last to be visited first; false: there is nothing to open.
    std::function<bool(Node_pair pair, std::vector<Node_pair>& below)> open;
    std::vector<Task> others = {};  ///< come after the walk
  };

  Contact_summary run(const Plan& plan, const Contact_request& request, std::vector<Face_pair>& found);
  std::size_t run_tasks(const Plan& plan, std::size_t limit);
  std::size_t run_side_by_side(const Plan& plan, std::size_t limit);
  bool run_one(const Task& task, std::size_t index, std::size_t limit, Scratch& scratch);

  Workers& workers_;
  std::vector<Scratch> scratch_;   ///< per worker
  std::vector<Result> results_;    ///< per task
  std::vector<Node_pair> starts_;  ///< of the tasks that share a walk
};

template <Bounding_volume Volume>
Contact_summary Contact_search::between(const Basic_tree_surface<Volume>& a, const Basic_tree_surface<Volume>& b,
                                        const Contact_request& request, std::vector<Face_pair>& found) {
  Plan plan;
  plan.leaves = a.tree().leaf_count() + b.tree().leaf_count();
  plan.walk = [&](std::size_t limit, Scratch& scratch, Result& result) {
    visit_contacts(a.view(), b.view(), request.tolerance, scratch.walk, [&](Face_pair pair) {
      result.found.push_back(pair);
      return result.found.size() < limit ? Visit::go_on : Visit::stop;
    });
    scratch.walk.resumes = true;
  };
  plan.open = [&](Node_pair pair, std::vector<Node_pair>& below) {
    if (!near(a.tree().volume(pair.a), b.tree().volume(pair.b), request.tolerance)) return true;  // nothing below
    return open_for_tasks(a.tree(), b.tree(), pair, request.tolerance, below);
  };
  return run(plan, request, found);
}

template <Bounding_volume Volume>
Contact_summary Contact_search::within(const Basic_tree_surface<Volume>& object, const Contact_request& request,
                                       std::vector<Face_pair>& found) {
  const auto& tree = object.tree();
  const Vertex_fans& fans = object.fans();
  Plan plan;
  plan.leaves = tree.leaf_count();
  plan.walk = [&](std::size_t limit, Scratch& scratch, Result& result) {
    visit_contacts_within(object.view(), scratch.walk, [&](Face_pair pair) {
      result.found.push_back(pair);
      return result.found.size() < limit ? Visit::go_on : Visit::stop;
    });
    scratch.walk.resumes = true;
  };
  plan.open = [&](Node_pair pair, std::vector<Node_pair>& below) {
    if (pair.a != pair.b && !near(tree.volume(pair.a), tree.volume(pair.b), 0)) return true;
    if (pair.a != pair.b) return open_for_tasks(tree, tree, pair, 0, below);
    if (tree.is_leaf(pair.a)) return false;
    open_node(tree, pair.a, below);
    return true;
  };
  constexpr std::uint32_t neighbour_vertices = 4096;  // of one task
  const auto vertices = static_cast<std::uint32_t>(object.vertex_count());
  for (std::uint32_t first = 0; first < vertices; first += std::min(neighbour_vertices, vertices - first)) {
    const std::uint32_t end = first + std::min(neighbour_vertices, vertices - first);
    plan.others.push_back([&, first, end](std::size_t, Scratch& scratch, Result& result) {
      scratch.neighbours.check(fans, object.corners(), object.coordinates(), first, end, result.found);
    });
  }
  return run(plan, request, found);
}

extern template Contact_summary Contact_search::between(const Tree_surface&, const Tree_surface&,
                                                        const Contact_request&, std::vector<Face_pair>&);
extern template Contact_summary Contact_search::within(const Tree_surface&, const Contact_request&,
                                                       std::vector<Face_pair>&);

}  // namespace lodestone
