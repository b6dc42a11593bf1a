// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/pair_contacts.h"

#include <algorithm>
#include <iterator>

namespace lodestone {

void prefer(std::span<const Face_pair> preferred, std::vector<Face_pair>& found, std::size_t begin) {
  if (preferred.empty()) return;
  std::vector<Face_pair> others;
  const auto first = found.begin() + static_cast<std::ptrdiff_t>(begin);
  std::set_difference(first, found.end(), preferred.begin(), preferred.end(), std::back_inserter(others));
  others.resize(found.size() - begin - preferred.size());
  std::merge(preferred.begin(), preferred.end(), others.begin(), others.end(), first);
}

void tell_which_intersect(std::span<const Face_pair> intersecting, std::span<const Face_pair> found, std::size_t begin,
                          std::vector<std::uint8_t>& intersects) {
  intersects.resize(found.size());
  auto next = intersecting.begin();
  for (std::size_t i = begin; i < found.size(); ++i) {
    while (next != intersecting.end() && *next < found[i]) ++next;
    intersects[i] = next != intersecting.end() && *next == found[i] ? 1 : 0;
  }
}

}  // namespace lodestone
