// SPDX-License-Identifier: GPL-3.0-or-later
#include "queries/ray_start_kernel.h"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "queries/ray_start_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The rays, or as many of them as a vector holds.
using Ray_lanes = hn::CappedTag<double, ray_tree_width>;
constexpr std::size_t ray_step = hn::MaxLanes(Ray_lanes());
/// A single ray: numbers are divided in half the time.
using One_lane = hn::CappedTag<double, 1>;

constexpr double farthest = 0x1p24;   // beyond, the error of an origin in double is above 2^-28
constexpr double wall = 1 + 0x1p-10;  // of the box that rays start at, with room for errors
constexpr double least_slope = 0x1p-40;
constexpr double deepest = 8;  // no point of the surface is deeper than 4

/// Chooses between axes: that along which a direction is largest, of several the first.
template <class Tag>
class Largest_axis {
 public:
  using Values = hn::Vec<Tag>;

  explicit Largest_axis(const Values (&direction)[3]) {
    const Values x = hn::Abs(direction[0]), y = hn::Abs(direction[1]), z = hn::Abs(direction[2]);
    second_ = hn::Gt(y, x);
    third_ = hn::Gt(z, hn::Max(x, y));
  }

  HWY_INLINE Values operator()(Values x, Values y, Values z) const {
    return hn::IfThenElse(third_, z, hn::IfThenElse(second_, y, x));
  }

 private:
  hn::Mask<Tag> second_, third_;
};

template <class Values>
HWY_INLINE void store_rounded(Values values, float* to) {
  const hn::Rebind<float, hn::DFromV<Values>> d;
  hn::StoreU(hn::DemoteTo(d, values), d, to);
}

template <class Values>
HWY_INLINE void store_index(Values values, std::uint32_t* to) {
  const hn::Rebind<std::int32_t, hn::DFromV<Values>> d;
  const hn::RebindToUnsigned<decltype(d)> u;
  hn::StoreU(hn::BitCast(u, hn::DemoteTo(d, values)), u, to);
}

/// @param i  the first ray of a vector
template <class Tag>
HWY_INLINE Ray_starts start_some(Tag d, const Relative_place& place, const Ray_numbers& rays, std::size_t i,
                                 Ray_walks& walks) {
  using Values = hn::Vec<Tag>;
  Values direction[3], origin[3], slope[3], true_slope[3], inverse[3];
  for (int axis = 0; axis < 3; ++axis) direction[axis] = hn::Load(d, rays.direction[axis] + i);
  const Largest_axis<Tag> largest(direction);
  const Values d_z = hn::Abs(largest(direction[0], direction[1], direction[2]));
  const Values scale = hn::Set(d, place.scale), one = hn::Set(d, 1.0);
  Values skipped = hn::Zero(d), last = hn::Set(d, std::numeric_limits<double>::infinity()), size = hn::Zero(d);
  for (int axis = 0; axis < 3; ++axis) {
    origin[axis] = hn::Mul(hn::Sub(hn::Load(d, rays.origin[axis] + i), hn::Set(d, place.middle[axis])), scale);
    size = hn::Max(size, hn::Abs(origin[axis]));
    // A ray that is nearly orthogonal to an axis is tilted where it enters the box: inside, that is far below the
    // error.
    true_slope[axis] = hn::Div(direction[axis], d_z);
    slope[axis] = hn::CopySign(hn::Max(hn::Abs(true_slope[axis]), hn::Set(d, least_slope)), true_slope[axis]);
    inverse[axis] = hn::Div(one, slope[axis]);
    const Values to_low = hn::Mul(hn::Sub(hn::Set(d, -wall), origin[axis]), inverse[axis]);
    const Values to_high = hn::Mul(hn::Sub(hn::Set(d, wall), origin[axis]), inverse[axis]);
    skipped = hn::Max(skipped, hn::Min(to_low, to_high));
    last = hn::Min(last, hn::Max(to_low, to_high));
  }
  const Values sign = largest(slope[0], slope[1], slope[2]);
  const Values start = hn::Add(hn::Mul(largest(origin[0], origin[1], origin[2]), sign), skipped);
  store_rounded(start, walks.start + i);
  const Values limit = hn::Sub(hn::Mul(hn::Load(d, rays.limit + i), scale), skipped);
  store_rounded(hn::Min(hn::Add(limit, hn::Set(d, walk_error)), hn::Set(d, deepest)), walks.most + i);
  store_index(largest(hn::Zero(d), one, hn::Set(d, 2.0)), walks.depth_axis + i);
  for (int axis = 0; axis < 3; ++axis) {
    const Values entry = hn::Add(origin[axis], hn::Mul(skipped, true_slope[axis]));
    const Values entered = hn::Mul(entry, inverse[axis]);
    const Values error = hn::Mul(hn::Set(d, walk_error), hn::Abs(inverse[axis]));
    store_rounded(slope[axis], walks.slope[axis] + i);
    store_rounded(inverse[axis], walks.inverse[axis] + i);
    store_rounded(hn::Add(entered, error), walks.enter[axis] + i);
    store_rounded(hn::Sub(entered, error), walks.leave[axis] + i);
    store_rounded(hn::Sub(entry, hn::Mul(slope[axis], start)), walks.across[axis] + i);
    const auto falls = hn::Lt(slope[axis], hn::Zero(d));
    const Values low = hn::Set(d, static_cast<double>(axis * ray_tree_width));
    const Values high = hn::Set(d, static_cast<double>((3 + axis) * ray_tree_width));
    store_index(hn::IfThenElse(falls, high, low), walks.near_side[axis] + i);
    store_index(hn::IfThenElse(falls, low, high), walks.far_side[axis] + i);
  }
  return {.near = mask_bits(d, hn::Lt(size, hn::Set(d, farthest))), .walks = mask_bits(d, hn::Le(skipped, last))};
}

Ray_starts start_rays_kernel(const Relative_place& place, const Ray_numbers& rays, std::size_t count,
                             Ray_walks& walks) {
  Ray_starts starts{};
  if (count == 1) {
    starts = start_some(One_lane(), place, rays, 0, walks);
    starts.walks &= starts.near;
    return starts;
  }
  for (std::size_t i = 0; i < ray_tree_width; i += ray_step) {
    const Ray_starts some = start_some(Ray_lanes(), place, rays, i, walks);
    starts.near |= some.near << i;
    starts.walks |= (some.near & some.walks) << i;
  }
  return starts;
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(start_rays_kernel);

Ray_starts start_rays(const Relative_place& place, const Ray_numbers& rays, std::size_t count, Ray_walks& walks) {
  return HWY_DYNAMIC_DISPATCH(start_rays_kernel)(place, rays, count, walks);
}

}  // namespace lodestone::kernel
#endif
