// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/contact/contact_search.h"

#include <algorithm>
#include <atomic>

#include "lodestone/contact/face_neighbours.h"

namespace lodestone {

namespace {

/// Tasks that a walk is cut into for several workers, and the vertices of one task of neighbours.
constexpr std::size_t walk_tasks = 256;
constexpr std::uint32_t neighbour_vertices = 4096;

/// Opens the first node pairs of a walk, level by level, until there are `walk_tasks`. The order is that of the walk.
template <class Open>
void open_top(std::vector<Node_pair>& pairs, Open open) {
  std::vector<Node_pair> below, opened;
  for (bool again = true; again && pairs.size() < walk_tasks; pairs.swap(opened)) {
    again = false;
    opened.clear();
    for (const Node_pair pair : pairs) {
      below.clear();
      if (open(pair, below)) {
        again = true;
        opened.insert(opened.end(), below.rbegin(), below.rend());
      } else {
        opened.push_back(pair);
      }
    }
  }
}

}  // namespace

Contact_search::Contact_search(Workers& workers) : workers_(workers), scratch_(workers.count()) {}

Contact_summary Contact_search::between(const Tree_object& a, const Tree_object& b, const Contact_request& request,
                                        std::vector<Face_pair>& found) {
  starts_.assign(1, {0, 0});
  if (workers_.count() > 1)
    open_top(starts_, [&](Node_pair pair, std::vector<Node_pair>& below) {
      if (!near(a.tree().box(pair.a), b.tree().box(pair.b), request.tolerance)) return true;  // nothing below
      if (a.tree().is_leaf(pair.a) && b.tree().is_leaf(pair.b)) return false;
      open_pair(a.tree(), b.tree(), pair, below);
      return true;
    });
  const auto walk = [&](std::size_t index, std::size_t limit, Scratch& scratch, Result& result) {
    scratch.walk.ahead.assign(1, starts_[index]);
    visit_contacts(a.posed(), b.posed(), request.tolerance, scratch.walk, [&](Face_pair pair) {
      result.found.push_back(pair);
      return result.found.size() < limit ? Visit::go_on : Visit::stop;
    });
  };
  return run(starts_.size(), request, walk, found);
}

Contact_summary Contact_search::within(const Tree_object& object, const Contact_request& request,
                                       std::vector<Face_pair>& found) {
  const Region_tree& tree = object.tree();
  const Vertex_fans& fans = object.fans();
  const auto vertices = static_cast<std::uint32_t>(object.vertex_count());
  starts_.assign(1, {0, 0});
  if (workers_.count() > 1)
    open_top(starts_, [&](Node_pair pair, std::vector<Node_pair>& below) {
      if (pair.a != pair.b && !near(tree.box(pair.a), tree.box(pair.b), 0)) return true;
      if (tree.is_leaf(pair.a) && tree.is_leaf(pair.b)) return false;
      if (pair.a == pair.b)
        open_node(tree, pair.a, below);
      else
        open_pair(tree, tree, pair, below);
      return true;
    });
  const auto walk_or_check = [&](std::size_t index, std::size_t limit, Scratch& scratch, Result& result) {
    if (index >= starts_.size()) {
      const auto first = static_cast<std::uint32_t>((index - starts_.size()) * neighbour_vertices);
      scratch.neighbours.check(fans, object.corners(), object.coordinates(), first,
                               std::min(vertices, first + neighbour_vertices), result.found);
      return;
    }
    scratch.walk.ahead.assign(1, starts_[index]);
    visit_contacts_within(object.posed(), scratch.walk, [&](Face_pair pair) {
      result.found.push_back(pair);
      return result.found.size() < limit ? Visit::go_on : Visit::stop;
    });
  };
  const std::size_t neighbour_tasks = (vertices + neighbour_vertices - 1) / neighbour_vertices;
  return run(starts_.size() + neighbour_tasks, request, walk_or_check, found);
}

Contact_summary Contact_search::run(std::size_t tasks, const Contact_request& request, const Task& task,
                                    std::vector<Face_pair>& found) {
  const bool all = request.query == Contact_query::all;
  // One more than may be listed tells whether the list is complete.
  const std::size_t most = all ? request.most : 1;
  const std::size_t limit = all ? most + (most < std::numeric_limits<std::size_t>::max() ? 1 : 0) : 1;
  const std::size_t first = found.size();

  results_.resize(std::max(results_.size(), tasks));
  const bool side_by_side = workers_.count() > 1 && (limit == 1 || limit == std::numeric_limits<std::size_t>::max());
  const std::size_t done = side_by_side ? run_side_by_side(tasks, limit, task) : run_in_order(tasks, limit, task);

  Contact_summary summary;
  for (std::size_t index = 0; index < done; ++index) {
    found.insert(found.end(), results_[index].found.begin(), results_[index].found.end());
    summary.leaf_tests += results_[index].leaf_tests;
    summary.exact_tests += results_[index].exact_tests;
  }
  summary.found = found.size() > first;
  summary.capped = all && found.size() - first > most;
  const std::size_t listed = request.query == Contact_query::yes_no ? 0 : std::min(most, found.size() - first);
  found.resize(first + listed);
  std::sort(found.begin() + static_cast<std::ptrdiff_t>(first), found.end());
  return summary;
}

std::size_t Contact_search::run_in_order(std::size_t tasks, std::size_t limit, const Task& task) {
  std::size_t listed = 0;
  for (std::size_t index = 0; index < tasks; ++index) {
    run_one(task, index, limit - listed, scratch_.front());
    listed += results_[index].found.size();
    if (listed >= limit) return index + 1;
  }
  return tasks;
}

/// Tasks after the first one that reaches the limit do not count, whether they have run or not: in order they would
/// not have been met.
std::size_t Contact_search::run_side_by_side(std::size_t tasks, std::size_t limit, const Task& task) {
  std::atomic<std::size_t> last = tasks;
  workers_.run(tasks, [&](std::size_t index, std::size_t worker) {
    if (index > last) return;
    run_one(task, index, limit, scratch_[worker]);
    if (results_[index].found.size() < limit) return;
    std::size_t before = last;
    while (index < before && !last.compare_exchange_weak(before, index)) {
    }
  });
  return std::min(tasks, last + 1);
}

void Contact_search::run_one(const Task& task, std::size_t index, std::size_t limit, Scratch& scratch) {
  Result& result = results_[index];
  result.found.clear();
  const std::size_t leaf_tests = scratch.walk.leaf_tests;
  const std::size_t exact_tests = scratch.walk.exact_tests + scratch.neighbours.exact_tests();
  task(index, limit, scratch, result);
  result.leaf_tests = scratch.walk.leaf_tests - leaf_tests;
  result.exact_tests = scratch.walk.exact_tests + scratch.neighbours.exact_tests() - exact_tests;
}

}  // namespace lodestone
