// SPDX-License-Identifier: GPL-3.0-or-later
#include "particles/force_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "particles/force_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

static_assert(point_lanes % double_lanes == 0);

void add_forces_kernel(const Attractor_columns& attractors, std::size_t begin, std::size_t end, const double* x,
                       const double* y, const double* z, double* forces) {
  const Double_lanes d;
  const auto one = hn::Set(d, 1.0);
  for (std::size_t lane = 0; lane < point_lanes; lane += double_lanes) {
    const Vector3<Double_lanes> point{hn::LoadU(d, x + lane), hn::LoadU(d, y + lane), hn::LoadU(d, z + lane)};
    auto sum = hn::LoadU(d, forces + lane);
    for (std::size_t j = begin; j < end; ++j) {
      const auto difference = point - Vector3<Double_lanes>{hn::Set(d, attractors.x[j]), hn::Set(d, attractors.y[j]),
                                                            hn::Set(d, attractors.z[j])};
      const auto squared = dot(difference, difference);
      const auto felt = hn::Lt(squared, hn::Set(d, attractors.squared_reach[j]));
      sum = hn::Add(sum, hn::IfThenElseZero(felt, hn::Div(one, squared)));
    }
    hn::StoreU(sum, d, forces + lane);
  }
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(add_forces_kernel);

void add_forces(const Attractor_columns& attractors, std::size_t begin, std::size_t end, const double* x,
                const double* y, const double* z, double* forces) {
  HWY_DYNAMIC_DISPATCH(add_forces_kernel)(attractors, begin, end, x, y, z, forces);
}

}  // namespace lodestone::kernel
#endif
