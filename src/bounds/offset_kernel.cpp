// SPDX-License-Identifier: GPL-3.0-or-later
#include "bounds/offset_kernel.h"

#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bounds/offset_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/positions-inl.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

Morph_shift add_offsets_kernel(std::span<const Offset_range> ranges, const double* weights) {
  const Position_lanes d;
  Morph_shift shift;
  double terms = 0;
  for (std::size_t k = 0; k < position_vectors; ++k) {
    auto low = hn::Zero(d), high = low, magnitude = low;
    terms = 0;
    for (const Offset_range& range : ranges) {
      const double weight = weights[range.target];
      if (weight == 0) continue;
      terms += 1;
      const auto by = hn::Set(d, weight);
      const auto one = hn::Mul(by, load_position(range.low.data(), k));
      const auto other = hn::Mul(by, load_position(range.high.data(), k));
      low = hn::Add(low, hn::Min(one, other));
      high = hn::Add(high, hn::Max(one, other));
      magnitude = hn::Add(magnitude, hn::Max(hn::Abs(one), hn::Abs(other)));
    }
    hn::StoreU(low, d, shift.low.data() + k * position_lanes);
    hn::StoreU(high, d, shift.high.data() + k * position_lanes);
    hn::StoreU(magnitude, d, shift.magnitude.data() + k * position_lanes);
  }
  if (terms == 0) return shift;  // nothing is rounded
  shift.rounding = (4 * terms + 16) * 0x1p-53;
  shift.underflow = terms * 0x1p-1020;
  return shift;
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(add_offsets_kernel);

Morph_shift add_offsets(std::span<const Offset_range> ranges, const double* weights) {
  return HWY_DYNAMIC_DISPATCH(add_offsets_kernel)(ranges, weights);
}

}  // namespace lodestone::kernel
#endif
