// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_LANE_LOOKUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_LANE_LOOKUP_INL_H
#undef LODESTONE_LANE_LOOKUP_INL_H
#else
#define LODESTONE_LANE_LOOKUP_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET <= HWY_AVX3
/// Indices of as many boxes as a vector holds sides.
using Side_index_lanes = hn::Rebind<std::uint16_t, Side_lanes>;

/// Looks up numbers in two registers of a column, as one table: the lowest bits of an index choose the number. Highway
/// 1.0.3 has no such function.
HWY_INLINE Floats look_up_block(const float* block, Indices indices) {
  const Float_lanes d;
  return Floats{_mm512_permutex2var_ps(hn::Load(d, block).raw, indices.raw, hn::Load(d, block + hn::Lanes(d)).raw)};
}
HWY_INLINE Indices look_up_block(const std::uint32_t* block, Indices indices) {
  const Index_lanes d;
  return Indices{_mm512_permutex2var_epi32(hn::Load(d, block).raw, indices.raw, hn::Load(d, block + hn::Lanes(d)).raw)};
}
HWY_INLINE Sides look_up_block(const std::int16_t* block, hn::Vec<Side_index_lanes> indices) {
  const Side_lanes d;
  return Sides{_mm512_permutex2var_epi16(hn::Load(d, block).raw, indices.raw, hn::Load(d, block + hn::Lanes(d)).raw)};
}

/// What some columns of numbers hold at some indices.
template <class T, class Index_tag, std::size_t columns>
struct Looked_up {
  hn::Vec<hn::Rebind<T, Index_tag>> of[columns];
};

/// @param count  every index is below it; a column is read in whole blocks
template <class Index_tag, class T, std::size_t column_count, std::size_t length>
HWY_INLINE auto look_up(Index_tag d, const T (&columns)[column_count][length], std::size_t count,
                        hn::Vec<Index_tag> indices) {
  constexpr std::size_t block = 2 * hn::MaxLanes(d);
  Looked_up<T, Index_tag, column_count> found;
  for (std::size_t c = 0; c < column_count; ++c) found.of[c] = look_up_block(columns[c], indices);
  for (std::size_t start = block; start < count; start += block) {
    const auto past = hn::Gt(indices, hn::Set(d, static_cast<hn::TFromD<Index_tag>>(start - 1)));
    const auto in_block = hn::RebindMask(hn::Rebind<T, Index_tag>(), past);
    for (std::size_t c = 0; c < column_count; ++c)
      found.of[c] = hn::IfThenElse(in_block, look_up_block(columns[c] + start, indices), found.of[c]);
  }
  return found;
}
#endif

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
