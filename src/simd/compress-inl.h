// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_COMPRESS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_COMPRESS_INL_H
#undef LODESTONE_COMPRESS_INL_H
#else
#define LODESTONE_COMPRESS_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "simd/lane_lists.h"
#include "simd/vector_types-inl.h"

// Moving chosen elements next to each other. How many are chosen is unpredictable, so all of this is branchless: as
// many elements are written as could be chosen.
HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Lists the indices of the set bits, of eight. Writes eight bytes.
/// @return number of set bits
HWY_INLINE std::size_t list_set_bits(std::uint32_t bits, std::uint8_t* list) {
  std::memcpy(list, lane_lists[bits].data(), 8);
  return hwy::PopCount(bits);
}

/// Copies the bytes whose bits are set, of as many as a vector holds floats. Writes that many bytes.
/// @param to  may be `from`, or lie before it
/// @return number of set bits
#if HWY_TARGET <= HWY_AVX3
HWY_INLINE std::size_t compress_float_lanes(std::uint32_t bits, const std::uint8_t* from, std::uint8_t* to) {
  const Index_lanes d;
  const hn::Rebind<std::uint8_t, Index_lanes> bytes;
  const std::uint8_t bits_as_bytes[8] = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8)};
  const auto numbers = hn::PromoteTo(d, hn::LoadU(bytes, from));
  const auto chosen = hn::Compress(numbers, hn::LoadMaskBits(d, bits_as_bytes));
  // Not `TruncateTo`: that of Highway 1.0.3 is wrong for HWY_AVX3_DL.
  hn::StoreU(hn::Vec<decltype(bytes)>{_mm512_cvtepi32_epi8(chosen.raw)}, bytes, to);
  return hwy::PopCount(bits);
}
#else
HWY_INLINE std::size_t compress_float_lanes(std::uint32_t bits, const std::uint8_t* from, std::uint8_t* to) {
  static_assert(float_lanes <= 8, "lists of eight bits");
  std::uint8_t all[float_lanes], chosen[8];
  std::memcpy(all, from, float_lanes);
  const std::size_t count = list_set_bits(bits, chosen);
  for (std::size_t i = 0; i < float_lanes; ++i) to[i] = all[chosen[i]];
  return count;
}
#endif

/// The same for as many bytes as a vector holds sides of boxes.
HWY_INLINE std::size_t compress_side_lanes(std::uint32_t bits, const std::uint8_t* from, std::uint8_t* to) {
  constexpr std::uint32_t block = (1U << float_lanes) - 1;
  std::size_t count = 0;
  for (std::size_t first = 0; first < side_lanes; first += float_lanes)
    count += compress_float_lanes(bits >> first & block, from + first, to + count);
  return count;
}

/// Stores the chosen lanes. Writes a whole vector.
/// @param bits  of `chosen`
HWY_INLINE void compress_store(Indices numbers, hn::Mask<Index_lanes> chosen, std::uint32_t bits, std::uint32_t* to) {
  const Index_lanes d;
#if HWY_TARGET <= HWY_AVX3
  static_cast<void>(bits);
  hn::StoreU(hn::Compress(numbers, chosen), d, to);
#else
  // Where there is no instruction for it, GCC 12 writes a table of a kilobyte at each call of Highway's `Compress`.
  static_assert(float_lanes <= 8, "lists of eight bits");
  static_cast<void>(chosen);
  const auto lanes = hn::PromoteTo(d, hn::LoadU(hn::Rebind<std::uint8_t, Index_lanes>(), lane_lists[bits].data()));
  hn::StoreU(hn::TableLookupLanes(numbers, hn::IndicesFromVec(d, lanes)), d, to);
#endif
}

/// Writes a byte `count` times, rounded up to a multiple of eight.
HWY_INLINE void repeat_byte(std::size_t byte, std::size_t count, std::uint8_t* to) {
  const std::uint64_t bytes = byte * 0x0101010101010101;
  for (std::size_t eight = 0; eight < count; eight += 8) std::memcpy(to + eight, &bytes, 8);
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
