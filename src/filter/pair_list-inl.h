// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_PAIR_LIST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_PAIR_LIST_INL_H
#undef LODESTONE_PAIR_LIST_INL_H
#else
#define LODESTONE_PAIR_LIST_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "filter/filter_scratch.h"
#include "simd/compress-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Repeats the last listed pair, of at least one, to the end of the last vector.
HWY_INLINE void pad_pairs(std::size_t count, Filter_scratch& scratch) {
  repeat_byte(scratch.pairs_a[count - 1], most_float_lanes, scratch.pairs_a + count);
  repeat_byte(scratch.pairs_b[count - 1], most_float_lanes, scratch.pairs_b + count);
}

/// Keeps chosen pairs in the list.
/// @param first, bits  which of them: bits from the `first`th pair on
/// @param kept         number of pairs kept so far, at most `first`
/// @return number of pairs kept with these
HWY_INLINE std::size_t keep_pairs(std::size_t first, std::uint32_t bits, std::size_t kept, Filter_scratch& scratch) {
  for (; bits != 0; bits &= bits - 1) {
    const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(bits);
    scratch.pairs_a[kept] = scratch.pairs_a[first + lane];
    scratch.pairs_b[kept] = scratch.pairs_b[first + lane];
    ++kept;
  }
  return kept;
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
