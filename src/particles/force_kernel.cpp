// SPDX-License-Identifier: GPL-3.0-or-later
#include "particles/force_kernel.h"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "particles/force_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void add_forces_kernel(const Attractor_columns& attractors, std::size_t begin, std::size_t end, const double* x,
                       const double* y, const double* z, double* forces) {
  const hn::CappedTag<double, point_lanes> d;
  const auto one = hn::Set(d, 1.0);
  for (std::size_t lane = 0; lane < point_lanes; lane += hn::Lanes(d)) {
    const auto px = hn::LoadU(d, x + lane);
    const auto py = hn::LoadU(d, y + lane);
    const auto pz = hn::LoadU(d, z + lane);
    auto sum = hn::LoadU(d, forces + lane);
    for (std::size_t j = begin; j < end; ++j) {
      const auto dx = hn::Sub(px, hn::Set(d, attractors.x[j]));
      const auto dy = hn::Sub(py, hn::Set(d, attractors.y[j]));
      const auto dz = hn::Sub(pz, hn::Set(d, attractors.z[j]));
      const auto squared = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
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
