// SPDX-License-Identifier: GPL-3.0-or-later
#include "queries/searches.h"

namespace lodestone {

bool operator==(const Search_answer& a, const Search_answer& b) {
  return a.found == b.found && a.summary.found == b.summary.found && a.summary.capped == b.summary.capped &&
         a.summary.leaf_tests == b.summary.leaf_tests && a.summary.exact_tests == b.summary.exact_tests;
}

Search_answer search_between(const Posed_object& a, const Posed_object& b, const Contact_request& request) {
  return Searcher(1).between(a, b, request);
}

Search_answer search_within(const Posed_object& object, const Contact_request& request) {
  return Searcher(1).within(object, request);
}

}  // namespace lodestone
