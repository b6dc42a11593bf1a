// SPDX-License-Identifier: GPL-3.0-or-later
#include "queries/face_pair_order.h"

#include <hwy/contrib/sort/vqsort.h>

#include <algorithm>
#include <cstdint>
#include <memory>

namespace lodestone {

namespace {

/// Below this number, std::sort is about as fast, and much faster where the code of both has to come to the cache
/// first.
constexpr std::size_t pays_from = 512;

}  // namespace

void sort_face_pairs(std::span<Face_pair> pairs) {
  if (pairs.size() < pays_from) {
    std::ranges::sort(pairs);
    return;
  }
  const auto keys = std::make_unique_for_overwrite<std::uint64_t[]>(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) keys[i] = std::uint64_t{pairs[i].a} << 32U | pairs[i].b;
  hwy::Sorter()(keys.get(), pairs.size(), hwy::SortAscending());
  for (std::size_t i = 0; i < pairs.size(); ++i)
    pairs[i] = {static_cast<std::uint32_t>(keys[i] >> 32U), static_cast<std::uint32_t>(keys[i])};
}

}  // namespace lodestone
