// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/orientation_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "triangles/orientation_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "triangles/plane_height-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void orientation_signs_kernel(const Point_quadruples& sets, double (&signs)[most_planes]) {
  const Plane_lanes d;
  for (std::size_t lane = 0; lane < sets.count; lane += hn::Lanes(d)) {
    const auto point = [&sets, lane](int i) { return load(sets.points[i], lane); };
    const Height s = height(plane_through(point(0), point(1), point(2)), point(3));
    const Plane_mask positive = hn::Gt(s.value.high, s.error), negative = hn::Lt(s.value.high, hn::Neg(s.error));
    const Planes sign = hn::IfThenElse(positive, all(1), hn::IfThenElseZero(negative, all(-1)));
    hn::StoreU(sign, d, signs + lane);
  }
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(orientation_signs_kernel);

void orientation_signs(const Point_quadruples& sets, double (&signs)[most_planes]) {
  HWY_DYNAMIC_DISPATCH(orientation_signs_kernel)(sets, signs);
}

}  // namespace lodestone::kernel
#endif
