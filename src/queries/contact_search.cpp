// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/contact_search.h"

#include "queries/face_pair_order.h"

namespace lodestone {

namespace {

bool wants_all(const Contact_request& request) { return request.query == Contact_query::all; }

/// Contacts that may be listed.
std::size_t most_listed(const Contact_request& request) {
  if (request.query == Contact_query::yes_no) return 0;
  return wants_all(request) ? request.most : 1;
}

}  // namespace

std::size_t contact_limit(const Contact_request& request) {
  if (!wants_all(request)) return 1;
  return request.most < std::numeric_limits<std::size_t>::max() ? request.most + 1 : request.most;
}

Contact_summary join_tasks(std::span<const Task_contacts> tasks, const Contact_request& request,
                           std::vector<Face_pair>& found) {
  const std::size_t first = found.size(), limit = contact_limit(request);
  Contact_summary summary;
  for (std::size_t task = 0; task < tasks.size() && found.size() - first < limit; ++task) {
    found.insert(found.end(), tasks[task].found.begin(), tasks[task].found.end());
    summary.leaf_tests += tasks[task].leaf_tests;
    summary.exact_tests += tasks[task].exact_tests;
  }
  const std::size_t contacts = found.size() - first;
  summary.found = contacts > 0;
  summary.capped = wants_all(request) && contacts > request.most;
  found.resize(first + std::min(most_listed(request), contacts));
  sort_face_pairs(std::span(found).subspan(first));
  return summary;
}

template class Basic_contact_search<Aabb>;

}  // namespace lodestone
