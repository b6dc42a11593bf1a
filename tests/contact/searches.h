// SPDX-License-Identifier: GPL-3.0-or-later
// What a search answers, and what must hold for any answer.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "face_soup.h"
#include "lodestone/contact/contact_search.h"

namespace lodestone {

struct Answer {
  Contact_summary summary;
  std::vector<Face_pair> found;
};

inline bool operator==(const Answer& a, const Answer& b) {
  return a.found == b.found && a.summary.found == b.summary.found && a.summary.capped == b.summary.capped &&
         a.summary.leaf_tests == b.summary.leaf_tests && a.summary.exact_tests == b.summary.exact_tests;
}

inline Answer search_between(const Posed_object& a, const Posed_object& b, const Contact_request& request = {},
                             std::size_t threads = 1) {
  Workers workers(threads);
  Contact_search search(workers);
  Answer answer;
  answer.summary = search.between(a.object(), b.object(), request, answer.found);
  return answer;
}

inline Answer search_within(const Posed_object& object, const Contact_request& request = {}, std::size_t threads = 1) {
  Workers workers(threads);
  Contact_search search(workers);
  Answer answer;
  answer.summary = search.within(object.object(), request, answer.found);
  return answer;
}

/// Checks every query and several caps against all true pairs, sorted. `ask(request)` gives an answer.
template <class Ask>
void expect_answers(const std::vector<Face_pair>& truth, double tolerance, const Ask& ask) {
  const Answer all = ask({.tolerance = tolerance});
  EXPECT_EQ(all.found, truth);
  EXPECT_EQ(all.summary.found, !truth.empty());
  EXPECT_FALSE(all.summary.capped);
  EXPECT_GE(all.summary.exact_tests, truth.size());

  const Answer yes_no = ask({.query = Contact_query::yes_no, .tolerance = tolerance});
  EXPECT_EQ(yes_no.summary.found, !truth.empty());
  EXPECT_FALSE(yes_no.summary.capped);
  EXPECT_TRUE(yes_no.found.empty());

  const Answer first = ask({.query = Contact_query::first, .tolerance = tolerance});
  EXPECT_EQ(first.summary.found, !truth.empty());
  EXPECT_FALSE(first.summary.capped);
  EXPECT_EQ(first.found.size(), std::min<std::size_t>(1, truth.size()));
  EXPECT_TRUE(std::ranges::includes(truth, first.found));

  const std::size_t size = truth.size();
  for (const std::size_t most : {std::size_t{1}, std::size_t{2}, size / 2, size - 1, size, size + 1, 2 * size}) {
    if (most == 0 || most == ~std::size_t{0}) continue;
    const Answer some = ask({.tolerance = tolerance, .most = most});
    EXPECT_EQ(some.found.size(), std::min(most, size)) << most;
    EXPECT_EQ(some.summary.capped, most < size) << most;
    EXPECT_EQ(some.summary.found, !truth.empty());
    EXPECT_TRUE(std::ranges::is_sorted(some.found));
    EXPECT_TRUE(std::ranges::includes(truth, some.found));
  }
}

}  // namespace lodestone
