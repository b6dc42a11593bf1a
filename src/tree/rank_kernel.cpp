// SPDX-License-Identifier: GPL-3.0-or-later
#include "tree/rank_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tree/rank_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Signed_lanes = hn::RebindToSigned<Index_lanes>;

/// Ranks the numbers of some vectors among all.
template <std::size_t vectors>
HWY_INLINE void rank_vectors(const std::int32_t* numbers, std::size_t count, std::size_t first, std::uint32_t* ranks) {
  const Signed_lanes d;
  hn::Vec<Signed_lanes> own[vectors], rank[vectors];
  for (std::size_t v = 0; v < vectors; ++v) {
    own[v] = hn::LoadU(d, numbers + first + v * float_lanes);
    rank[v] = hn::Zero(d);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const auto other = hn::Set(d, numbers[i]);
    for (std::size_t v = 0; v < vectors; ++v)  // a mask as a vector is -1 where it is set
      rank[v] = hn::Sub(rank[v], hn::VecFromMask(d, hn::Lt(other, own[v])));
  }
  for (std::size_t v = 0; v < vectors; ++v)
    hn::StoreU(hn::BitCast(Index_lanes(), rank[v]), Index_lanes(), ranks + first + v * float_lanes);
}

void find_ranks_kernel(const std::uint32_t* numbers, std::size_t count, std::uint32_t* ranks) {
  // In the same order as signed numbers, which every instruction set can compare.
  std::int32_t as_signed[most_ranked + most_float_lanes];
  for (std::size_t i = 0; i < count; ++i) as_signed[i] = static_cast<std::int32_t>(numbers[i] ^ 0x80000000U);
  for (std::size_t i = count; i < count + float_lanes; ++i) as_signed[i] = 0;
  std::size_t first = 0;
  for (; first + 3 * float_lanes < count; first += 4 * float_lanes) rank_vectors<4>(as_signed, count, first, ranks);
  for (; first < count; first += float_lanes) rank_vectors<1>(as_signed, count, first, ranks);
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(find_ranks_kernel);

void find_ranks(std::span<const std::uint32_t> numbers, Ranks& ranks) {
  HWY_DYNAMIC_DISPATCH(find_ranks_kernel)(numbers.data(), numbers.size(), ranks.data());
}

void sort_few(std::span<std::uint32_t> numbers) {
  Ranks ranks;
  find_ranks(numbers, ranks);
  std::array<std::uint32_t, most_ranked> sorted;
  for (std::size_t i = 0; i < numbers.size(); ++i) sorted[ranks[i]] = numbers[i];
  std::copy_n(sorted.begin(), numbers.size(), numbers.begin());
}

}  // namespace lodestone::kernel
#endif
