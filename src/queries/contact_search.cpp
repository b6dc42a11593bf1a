// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/contact_search.h"

#include <algorithm>
#include <atomic>

#include "lodestone/queries/face_pair_order.h"

namespace lodestone {

namespace {

/// Pairs of leaves that are looked at before other workers are woken: some 50 microseconds in small trees. Mostly
/// nothing is left after them, or one of them has the first face pair, if that is all that is asked for. A walk over
/// trees of many leaves for all face pairs mostly is a long one: the others begin at once.
std::size_t tests_alone(std::size_t leaves, std::size_t limit) { return leaves < 1024 || limit == 1 ? 64 : 4; }
/// Tasks that the rest of a walk is cut into, per worker: it takes one thread to find them.
constexpr std::size_t walk_tasks = 32;

/// Opens the first node pairs of a walk, level by level, until there are so many more: many of those that there are
/// already may be pairs of leaves. The order is that of the walk.
template <class Open>
void open_top(std::vector<Node_pair>& pairs, std::size_t more, Open open) {
  const std::size_t enough = pairs.size() + more;
  std::vector<Node_pair> below, opened;
  for (bool again = true; again && pairs.size() < enough; pairs.swap(opened)) {
    again = false;
    opened.clear();
    for (const Node_pair pair : pairs) {
      below.clear();
      if (opened.size() < enough && open(pair, below)) {
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

Contact_summary Contact_search::run(const Plan& plan, const Contact_request& request, std::vector<Face_pair>& found) {
  const bool all = request.query == Contact_query::all;
  // One more than may be listed tells whether the list is complete.
  const std::size_t most = all ? request.most : 1;
  const std::size_t limit = all && most < std::numeric_limits<std::size_t>::max() ? most + 1 : most;
  const std::size_t first = found.size();

  const std::size_t done = run_tasks(plan, limit);
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
  sort_face_pairs(std::span(found).subspan(first));
  return summary;
}

/// The walk begins in one thread, which mostly ends it: waking others takes longer than a small walk. The rest, if
/// there is any, is shared.
/// @return number of results that count
std::size_t Contact_search::run_tasks(const Plan& plan, std::size_t limit) {
  for (Scratch& scratch : scratch_) scratch.walk.resumes = false;
  const bool shared = workers_.count() > 1 && (limit == 1 || limit == std::numeric_limits<std::size_t>::max());
  results_.resize(std::max<std::size_t>(results_.size(), 1));
  Tree_walk& walk = scratch_.front().walk;
  walk.ahead.assign(1, {0, 0});
  walk.last_leaf_test =
      shared ? walk.leaf_tests + tests_alone(plan.leaves, limit) : std::numeric_limits<std::size_t>::max();
  const bool full = run_one(plan.walk, 0, limit, scratch_.front());
  walk.last_leaf_test = std::numeric_limits<std::size_t>::max();
  if (full) return 1;

  if (shared) return run_side_by_side(plan, limit);
  results_.resize(std::max(results_.size(), 1 + plan.others.size()));
  std::size_t listed = results_[0].found.size();
  for (std::size_t other = 0; other < plan.others.size(); ++other) {
    if (run_one(plan.others[other], 1 + other, limit - listed, scratch_.front())) return 2 + other;
    listed += results_[1 + other].found.size();
  }
  return 1 + plan.others.size();
}

/// Tasks after the first one that reaches the limit do not count, whether they have run or not: in order they would
/// not have been met.
std::size_t Contact_search::run_side_by_side(const Plan& plan, std::size_t limit) {
  starts_.assign(scratch_.front().walk.ahead.rbegin(), scratch_.front().walk.ahead.rend());
  open_top(starts_, walk_tasks * workers_.count(), plan.open);
  const std::size_t tasks = starts_.size() + plan.others.size();
  results_.resize(std::max(results_.size(), 1 + tasks));
  std::atomic<std::size_t> last = tasks;
  workers_.run(tasks, [&](std::size_t index, std::size_t worker) {
    if (index > last) return;
    Scratch& scratch = scratch_[worker];
    if (index < starts_.size()) scratch.walk.ahead.assign(1, starts_[index]);
    const Task& task = index < starts_.size() ? plan.walk : plan.others[index - starts_.size()];
    if (!run_one(task, 1 + index, limit, scratch)) return;
    std::size_t before = last;
    while (index < before && !last.compare_exchange_weak(before, index)) {
    }
  });
  return 1 + std::min(tasks, last + 1);
}

/// @return whether the limit has been reached
bool Contact_search::run_one(const Task& task, std::size_t index, std::size_t limit, Scratch& scratch) {
  Result& result = results_[index];
  result.found.clear();
  const std::size_t leaf_tests = scratch.walk.leaf_tests;
  const std::size_t exact_tests = scratch.walk.exact_tests + scratch.neighbours.exact_tests();
  task(limit, scratch, result);
  result.leaf_tests = scratch.walk.leaf_tests - leaf_tests;
  result.exact_tests = scratch.walk.exact_tests + scratch.neighbours.exact_tests() - exact_tests;
  return result.found.size() >= limit;
}

template Contact_summary Contact_search::between(const Tree_surface&, const Tree_surface&, const Contact_request&,
                                                 std::vector<Face_pair>&);
template Contact_summary Contact_search::within(const Tree_surface&, const Contact_request&, std::vector<Face_pair>&);

}  // namespace lodestone
