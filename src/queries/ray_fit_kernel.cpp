// SPDX-License-Identifier: GPL-3.0-or-later
#include "queries/ray_fit_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "queries/ray_fit_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/positions-inl.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// As many floats as a vector holds doubles.
using Rounded_lanes = hn::Rebind<float, Double_lanes>;
using Rounded = hn::Vec<Rounded_lanes>;
static_assert(ray_tree_width % double_lanes == 0);

/// A relative coordinate that no ray comes to.
constexpr float beyond_all_rays = 0x1p30F;

HWY_INLINE void fit_block(const double* coordinates, const Relative_place& place, Ray_block& block, Ray_box& box) {
  const Double_lanes d;
  const Rounded_lanes rounded;
  const auto middle = in_all_lanes(d, place.middle);
  const Doubles scale = hn::Set(d, place.scale);
  Rounded low[3], high[3];
  for (std::size_t axis = 0; axis < 3; ++axis) low[axis] = hn::Set(rounded, 4.0F), high[axis] = hn::Set(rounded, -4.0F);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < ray_tree_width; i += double_lanes) {
      const auto p = load_positions([&](std::size_t lane) HWY_ATTR {
                       return coordinates + 3 * std::size_t{block.vertices[c][i + lane]};
                     }) -
                     middle;
      const auto is_face = hn::FirstN(rounded, block.count > i ? block.count - i : 0);
      const Rounded at[]{hn::DemoteTo(rounded, hn::Mul(p.x, scale)), hn::DemoteTo(rounded, hn::Mul(p.y, scale)),
                         hn::DemoteTo(rounded, hn::Mul(p.z, scale))};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        // Beyond the last face it is repeated, so the box is that of the faces.
        low[axis] = hn::Min(low[axis], at[axis]);
        high[axis] = hn::Max(high[axis], at[axis]);
        hn::StoreU(hn::IfThenElse(is_face, at[axis], hn::Set(rounded, beyond_all_rays)), rounded,
                   block.corners[c][axis] + i);
      }
    }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] = hn::GetLane(hn::MinOfLanes(rounded, low[axis]));
    box.high[axis] = hn::GetLane(hn::MaxOfLanes(rounded, high[axis]));
  }
}

void fit_blocks_kernel(const double* coordinates, const Relative_place& place, std::span<Ray_block> blocks,
                       Ray_box* boxes) {
  for (std::size_t b = 0; b < blocks.size(); ++b) fit_block(coordinates, place, blocks[b], boxes[b]);
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(fit_blocks_kernel);

void fit_blocks(const double* coordinates, const Relative_place& place, std::span<Ray_block> blocks, Ray_box* boxes) {
  HWY_DYNAMIC_DISPATCH(fit_blocks_kernel)(coordinates, place, blocks, boxes);
}

}  // namespace lodestone::kernel
#endif
