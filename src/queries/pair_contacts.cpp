// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/pair_contacts.h"

#include <algorithm>
#include <iterator>

namespace lodestone {

void prefer(std::span<const Face_pair> preferred, std::vector<Face_pair>& found, std::size_t begin) {
  if (preferred.empty()) return;
  std::vector<Face_pair> others;
  std::ranges::set_difference(std::span(found).subspan(begin), preferred, std::back_inserter(others));
  others.resize(found.size() - begin - preferred.size());
  std::ranges::merge(preferred, others, found.begin() + static_cast<std::ptrdiff_t>(begin));
}

}  // namespace lodestone
