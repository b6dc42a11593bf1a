// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/sides_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "mesh/sides_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/positions-inl.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void sides_beyond_kernel(const double* coordinates, std::size_t positions, const double* low, const double* high,
                         std::uint8_t* sides) {
  const Position_lanes d;
  Position_vector lowest[position_vectors], highest[position_vectors];
  for (std::size_t i = 0; i < position_vectors; ++i) {
    lowest[i] = load_position(low, i);
    highest[i] = load_position(high, i);
  }
  const auto sides_of = [&](const auto& vector) HWY_ATTR {
    std::uint32_t below = 0, above = 0;
    for (std::size_t i = 0; i < position_vectors; ++i) {
      const Position_vector position = vector(i);
      below |= mask_bits(d, hn::Lt(position, lowest[i])) << (i * position_lanes);
      above |= mask_bits(d, hn::Gt(position, highest[i])) << (i * position_lanes);
    }
    return static_cast<std::uint8_t>((below & 7U) | (above & 7U) << 3U);
  };
  for (std::size_t p = 0; p + 1 < positions; ++p)
    sides[p] = sides_of([&](std::size_t i) HWY_ATTR { return load_inner_position(coordinates + 3 * p, i); });
  if (positions == 0) return;
  const double* last = coordinates + 3 * (positions - 1);
  sides[positions - 1] = sides_of([&](std::size_t i) HWY_ATTR { return load_position(last, i); });
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(sides_beyond_kernel);

void sides_beyond(const double* coordinates, std::size_t positions, const double* low, const double* high,
                  std::uint8_t* sides) {
  HWY_DYNAMIC_DISPATCH(sides_beyond_kernel)(coordinates, positions, low, high, sides);
}

}  // namespace lodestone::kernel
#endif
