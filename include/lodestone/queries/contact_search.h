// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "lodestone/mesh/pairs.h"
#include "lodestone/mesh/workers.h"
#include "lodestone/queries/contact_walk.h"
#include "lodestone/tree/tree_surface.h"
#include "lodestone/triangles/neighbour_check.h"

namespace lodestone {

/// What a search for contacts is to find.
struct Contact_request {
  Contact_query query = Contact_query::all;  ///< whether, one, or all
  double tolerance = 0;  ///< distance below which two faces are a contact, in units of the coordinates; >= 0; 0: they
                         ///< must intersect
  std::size_t most = std::numeric_limits<std::size_t>::max();  ///< contacts listed at most; >= 1
};

/// What a search found. The same for any number of workers.
struct Contact_summary {
  bool found = false;           ///< whether there is a contact
  bool capped = false;          ///< there are more contacts than `Contact_request::most`
  std::size_t leaf_tests = 0;   ///< leaf pairs tested
  std::size_t exact_tests = 0;  ///< face pairs given to exact predicates
};

/// What one task of a search found.
struct Task_contacts {
  std::vector<Face_pair> found;  ///< in no particular order
  std::size_t leaf_tests = 0;    ///< leaf pairs tested
  std::size_t exact_tests = 0;   ///< face pairs given to exact predicates
};

/// Contacts after which a search can end: one more than may be listed tells whether the list is complete.
std::size_t contact_limit(const Contact_request& request);
/// The contacts of tasks one after the other, up to the task with which the limit is reached. Appends those that are
/// listed to `found`, sorted.
Contact_summary join_tasks(std::span<const Task_contacts> tasks, const Contact_request& request,
                           std::vector<Face_pair>& found);

/// Finds the contacts of two objects, or of one with itself, and shares the work among workers. Keeps its memory from
/// one search to the next.
///
/// A search is a list of tasks: the start of the walk, the parts of the rest of the walk, and in one object the checks
/// of faces that share vertices. The answer is made of the tasks in this order, see `join_tasks`, so it does not depend
/// on the number of workers.
template <Bounding_volume Volume>
class Basic_contact_search {
 public:
  using Surface = Basic_tree_surface<Volume>;  ///< an object to be searched

  /// @param workers  must outlive this
  explicit Basic_contact_search(Workers& workers) : workers_(workers), memory_(workers.count()), tasks_(1) {}

  /// Appends the contacts of two objects to `found`, sorted; none for the query `yes_no`.
  Contact_summary between(const Surface& a, const Surface& b, const Contact_request& request,
                          std::vector<Face_pair>& found) {
    for (Memory& memory : memory_) memory.walk.begin(a.view(), b.view(), request.tolerance);
    neighbours_of_ = nullptr;
    return search(a.tree().leaf_count() + b.tree().leaf_count(), request, found);
  }
  /// Appends the contacts within one object, face pairs a < b, to `found`, sorted; none for the query `yes_no`. Faces
  /// that share vertices are contacts if they intersect, as `faces_intersect` says. Others also if they are nearer than
  /// the tolerance, unless they have been nearer than twice the tolerance at rest (`Object_surface::rest`).
  Contact_summary within(const Surface& object, const Contact_request& request, std::vector<Face_pair>& found) {
    for (Memory& memory : memory_) memory.walk.begin_within(object.view(), request.tolerance, object.rest());
    object.fans();  // computed on first use, which must not be in several threads at once
    neighbours_of_ = &object;
    return search(object.tree().leaf_count(), request, found);
  }

 private:
  /// What one worker keeps.
  struct Memory {
    Contact_walk<Volume> walk;
    Neighbour_check neighbours;
  };

  static constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();
  /// Parts of the walk per worker. One thread cuts them.
  static constexpr std::size_t parts_per_worker = 32;
  /// Vertices of one task that checks neighbours.
  static constexpr std::size_t vertices_per_task = 4096;

  /// Leaf pairs that are tested before other workers are woken: some 50 microseconds in small trees. Few walks have
  /// anything left after them, and where one contact is enough it is mostly among them. A walk for all contacts of
  /// trees with many leaves is usually long: the others begin at once.
  static std::size_t budget_alone(std::size_t leaves, std::size_t limit) {
    return leaves < 1024 || limit == 1 ? 64 : 4;
  }

  Contact_summary search(std::size_t leaves, const Contact_request& request, std::vector<Face_pair>& found);
  void walk_alone(std::size_t limit, std::size_t budget);
  void list_tasks(std::size_t parts);
  void run_in_order(std::size_t limit);
  void run_side_by_side(std::size_t limit);
  void run_task(std::size_t task, std::size_t limit, Memory& memory);
  static void walk_on(Contact_walk<Volume>& walk, std::size_t limit, std::size_t budget, Task_contacts& result);
  void check_neighbours(std::size_t first_vertex, Neighbour_check& neighbours, Task_contacts& result) const;

  Workers& workers_;
  std::vector<Memory> memory_;              ///< per worker
  const Surface* neighbours_of_ = nullptr;  ///< null: a search between two objects
  std::vector<Node_pair> starts_;           ///< of the parts of the walk
  std::vector<Task_contacts> tasks_;        ///< those of this search, then memory of earlier ones
  std::size_t task_count_ = 0;              ///< of this search
};

using Contact_search = Basic_contact_search<Aabb>;  ///< over trees of boxes

/// One thread begins and usually finishes: waking others takes longer than a small walk. What is left is shared.
template <Bounding_volume Volume>
Contact_summary Basic_contact_search<Volume>::search(std::size_t leaves, const Contact_request& request,
                                                     std::vector<Face_pair>& found) {
  const std::size_t limit = contact_limit(request);
  // Under a cap a task may find only what earlier tasks leave to it, so tasks run in order.
  const bool shared = workers_.count() > 1 && (limit == 1 || limit == no_limit);
  walk_alone(limit, shared ? budget_alone(leaves, limit) : no_budget);
  if (tasks_.front().found.size() < limit) {
    list_tasks(shared ? parts_per_worker * workers_.count() : 0);
    if (shared)
      run_side_by_side(limit);
    else
      run_in_order(limit);
  }
  return join_tasks(std::span(tasks_).first(task_count_), request, found);
}

/// Task 0.
template <Bounding_volume Volume>
void Basic_contact_search<Volume>::walk_alone(std::size_t limit, std::size_t budget) {
  task_count_ = 1;
  walk_on(memory_.front().walk, limit, budget, tasks_.front());
}

/// The tasks after task 0: what task 0 has left of the walk, in parts, then the checks of neighbours.
template <Bounding_volume Volume>
void Basic_contact_search<Volume>::list_tasks(std::size_t parts) {
  memory_.front().walk.split(parts, starts_);
  const std::size_t vertices = neighbours_of_ == nullptr ? 0 : neighbours_of_->vertex_count();
  task_count_ += starts_.size() + (vertices + vertices_per_task - 1) / vertices_per_task;
  tasks_.resize(std::max(tasks_.size(), task_count_));
}

template <Bounding_volume Volume>
void Basic_contact_search<Volume>::run_in_order(std::size_t limit) {
  std::size_t left = limit - tasks_.front().found.size();
  for (std::size_t task = 1; task < task_count_ && left > 0; ++task) {
    run_task(task, left, memory_.front());
    left -= std::min(left, tasks_[task].found.size());
  }
}

/// Skips tasks after one that has reached the limit by itself: `join_tasks` does not look at them.
template <Bounding_volume Volume>
void Basic_contact_search<Volume>::run_side_by_side(std::size_t limit) {
  std::atomic<std::size_t> last = task_count_;
  workers_.run(task_count_ - 1, [&](std::size_t index, std::size_t worker) {
    const std::size_t task = 1 + index;
    if (task > last) return;
    run_task(task, limit, memory_[worker]);
    if (tasks_[task].found.size() < limit) return;
    std::size_t before = last;
    while (task < before && !last.compare_exchange_weak(before, task)) {
    }
  });
}

template <Bounding_volume Volume>
void Basic_contact_search<Volume>::run_task(std::size_t task, std::size_t limit, Memory& memory) {
  const std::size_t index = task - 1;
  if (index < starts_.size()) {
    memory.walk.start(starts_[index]);
    walk_on(memory.walk, limit, no_budget, tasks_[task]);
  } else {
    check_neighbours((index - starts_.size()) * vertices_per_task, memory.neighbours, tasks_[task]);
  }
}

/// Walks on until the task has found `limit` contacts, or the budget is used up.
template <Bounding_volume Volume>
void Basic_contact_search<Volume>::walk_on(Contact_walk<Volume>& walk, std::size_t limit, std::size_t budget,
                                           Task_contacts& result) {
  result.found.clear();
  walk.run(
      [&](Face_pair contact) {
        result.found.push_back(contact);
        return result.found.size() < limit ? Visit::go_on : Visit::stop;
      },
      budget);
  result.leaf_tests = walk.leaf_tests();
  result.exact_tests = walk.exact_tests();
}

/// Finds all contacts whose lowest common vertex is one of `vertices_per_task`.
template <Bounding_volume Volume>
void Basic_contact_search<Volume>::check_neighbours(std::size_t first_vertex, Neighbour_check& neighbours,
                                                    Task_contacts& result) const {
  const Surface& object = *neighbours_of_;
  const std::size_t end = std::min(first_vertex + vertices_per_task, object.vertex_count());
  result.found.clear();
  neighbours.reset_count();
  neighbours.check(object.fans(), object.corners(), object.coordinates(), static_cast<std::uint32_t>(first_vertex),
                   static_cast<std::uint32_t>(end), result.found);
  result.leaf_tests = 0;
  result.exact_tests = neighbours.exact_tests();
}

extern template class Basic_contact_search<Aabb>;

}  // namespace lodestone
