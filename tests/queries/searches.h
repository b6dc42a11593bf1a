// SPDX-License-Identifier: GPL-3.0-or-later
// What a search returns, and checks that hold for any search.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "lodestone/queries/contact_search.h"
#include "support/face_soup.h"

namespace lodestone {

struct Search_answer {
  Contact_summary summary;
  std::vector<Face_pair> found;
};

bool operator==(const Search_answer& a, const Search_answer& b);

/// A search with workers of its own, which is reused.
class Searcher {
 public:
  explicit Searcher(std::size_t threads) : workers_(threads), search_(workers_) {}

  Search_answer between(const Posed_object& a, const Posed_object& b, const Contact_request& request) {
    Search_answer answer;
    answer.summary = search_.between(a.object(), b.object(), request, answer.found);
    return answer;
  }
  Search_answer within(const Posed_object& object, const Contact_request& request) {
    Search_answer answer;
    answer.summary = search_.within(object.object(), request, answer.found);
    return answer;
  }

 private:
  Workers workers_;
  Contact_search search_;
};

Search_answer search_between(const Posed_object& a, const Posed_object& b, const Contact_request& request = {});
Search_answer search_within(const Posed_object& object, const Contact_request& request = {});

/// Checks that searchers with any number of workers answer as one with a single worker. `ask(searcher, request)` gives
/// an answer.
template <class Ask>
void expect_same_for_any_workers(std::size_t contacts, const Ask& ask) {
  const std::vector<Contact_request> requests{{},
                                              {.query = Contact_query::first},
                                              {.query = Contact_query::yes_no},
                                              {.most = 1},
                                              {.most = contacts / 2 + 1},
                                              {.most = contacts},
                                              {.most = contacts + 1},
                                              {.tolerance = 0.01},
                                              {.query = Contact_query::first, .tolerance = 0.01},
                                              {.tolerance = 0.01, .most = 100}};
  Searcher alone(1);
  std::vector<Search_answer> expected;
  for (const auto& request : requests) expected.push_back(ask(alone, request));
  for (const std::size_t threads : {2, 3, 4, 7}) {
    Searcher several(threads);
    for (std::size_t i = 0; i < requests.size(); ++i)
      EXPECT_TRUE(ask(several, requests[i]) == expected[i]) << "request " << i << ", " << threads << " workers";
  }
}

/// Checks every query and several caps against all true pairs, sorted. `ask(request)` gives an answer.
template <class Ask>
void expect_answers(const std::vector<Face_pair>& truth, double tolerance, const Ask& ask) {
  const Search_answer all = ask({.tolerance = tolerance});
  EXPECT_EQ(all.found, truth);
  EXPECT_EQ(all.summary.found, !truth.empty());
  EXPECT_FALSE(all.summary.capped);
  EXPECT_GE(all.summary.exact_tests, truth.size());

  const Search_answer yes_no = ask({.query = Contact_query::yes_no, .tolerance = tolerance});
  EXPECT_EQ(yes_no.summary.found, !truth.empty());
  EXPECT_FALSE(yes_no.summary.capped);
  EXPECT_TRUE(yes_no.found.empty());

  const Search_answer first = ask({.query = Contact_query::first, .tolerance = tolerance});
  EXPECT_EQ(first.summary.found, !truth.empty());
  EXPECT_FALSE(first.summary.capped);
  EXPECT_EQ(first.found.size(), std::min<std::size_t>(1, truth.size()));
  EXPECT_TRUE(std::ranges::includes(truth, first.found));

  const std::size_t size = truth.size();
  for (const std::size_t most : {std::size_t{1}, std::size_t{2}, size / 2, size - 1, size, size + 1, 2 * size}) {
    if (most == 0 || most == ~std::size_t{0}) continue;
    const Search_answer some = ask({.tolerance = tolerance, .most = most});
    EXPECT_EQ(some.found.size(), std::min(most, size)) << most;
    EXPECT_EQ(some.summary.capped, most < size) << most;
    EXPECT_EQ(some.summary.found, !truth.empty());
    EXPECT_TRUE(std::ranges::is_sorted(some.found));
    EXPECT_TRUE(std::ranges::includes(truth, some.found));
  }
}

}  // namespace lodestone
