// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/aabb_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "volumes/aabb_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/positions-inl.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void fit_box_kernel(const double* coordinates, const std::uint32_t* vertices, std::size_t count, Aabb& box) {
  const Position_lanes d;
  const auto position = [&](std::size_t k) { return coordinates + 3 * std::size_t{vertices[k]}; };
  for (std::size_t i = 0; i < position_vectors; ++i) {
    // Even and odd vertices apart: two short chains of dependent instructions instead of a long one.
    auto low = load_position(position(0), i), high = low, other_low = low, other_high = low;
    std::size_t k = 1;
    for (; k + 1 < count; k += 2) {
      const auto p = load_position(position(k), i), q = load_position(position(k + 1), i);
      low = hn::Min(low, p);
      high = hn::Max(high, p);
      other_low = hn::Min(other_low, q);
      other_high = hn::Max(other_high, q);
    }
    if (k < count) {
      const auto p = load_position(position(k), i);
      low = hn::Min(low, p);
      high = hn::Max(high, p);
    }
    hn::StoreU(hn::Min(low, other_low), d, box.low + i * position_lanes);
    hn::StoreU(hn::Max(high, other_high), d, box.high + i * position_lanes);
  }
  box.low[3] = box.high[3] = 0;
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(fit_box_kernel);

void fit_box(const double* coordinates, const std::uint32_t* vertices, std::size_t count, Aabb& box) {
  HWY_DYNAMIC_DISPATCH(fit_box_kernel)(coordinates, vertices, count, box);
}

}  // namespace lodestone::kernel
#endif
