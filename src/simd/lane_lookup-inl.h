// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_LANE_LOOKUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_LANE_LOOKUP_INL_H
#undef LODESTONE_LANE_LOOKUP_INL_H
#else
#define LODESTONE_LANE_LOOKUP_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <type_traits>

#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET <= HWY_AVX3
/// As many places as a vector holds sides of boxes.
using Box_places = hn::Rebind<std::uint16_t, Box_lanes>;

/// Two registers of a column looked up as one table, of which the lowest bits of a place choose a number. Highway has
/// no such function yet.
HWY_INLINE Floats look_up_block(const float* block, hn::Vec<Vertex_lanes> places) {
  const Float_lanes d;
  return Floats{_mm512_permutex2var_ps(hn::Load(d, block).raw, places.raw, hn::Load(d, block + hn::Lanes(d)).raw)};
}
HWY_INLINE hn::Vec<Vertex_lanes> look_up_block(const std::uint32_t* block, hn::Vec<Vertex_lanes> places) {
  const Vertex_lanes d;
  return hn::Vec<Vertex_lanes>{
      _mm512_permutex2var_epi32(hn::Load(d, block).raw, places.raw, hn::Load(d, block + hn::Lanes(d)).raw)};
}
HWY_INLINE Sides look_up_block(const std::int16_t* block, hn::Vec<Box_places> places) {
  const Box_lanes d;
  return Sides{_mm512_permutex2var_epi16(hn::Load(d, block).raw, places.raw, hn::Load(d, block + hn::Lanes(d)).raw)};
}

/// What some columns of numbers hold at some places.
template <class T, class Places, std::size_t columns>
struct Looked_up {
  hn::Vec<hn::Rebind<T, Places>> of[columns];
};

/// @param count  every place is below it; a column is read in whole blocks
template <class Places, class T, std::size_t column_count, std::size_t length>
HWY_INLINE auto look_up(Places d, const T (&columns)[column_count][length], std::size_t count, hn::Vec<Places> places) {
  constexpr std::size_t block = 2 * hn::MaxLanes(d);
  Looked_up<T, Places, column_count> found;
  for (std::size_t c = 0; c < column_count; ++c) found.of[c] = look_up_block(columns[c], places);
  for (std::size_t start = block; start < count; start += block) {
    const auto past = hn::Gt(places, hn::Set(d, static_cast<hn::TFromD<Places>>(start - 1)));
    const auto in_block = hn::RebindMask(hn::Rebind<T, Places>(), past);
    for (std::size_t c = 0; c < column_count; ++c)
      found.of[c] = hn::IfThenElse(in_block, look_up_block(columns[c] + start, places), found.of[c]);
  }
  return found;
}
#endif

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
