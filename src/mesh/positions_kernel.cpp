// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/positions_kernel.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "mesh/positions_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/positions-inl.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Lane i of vector v is an x, y or z, by (v * lanes + i) modulo 3: three vectors in turn keep the axes apart.
class Box_of_positions {
 public:
  HWY_INLINE Box_of_positions() {
    const Double_lanes d;
    for (std::size_t v = 0; v < 3; ++v) {
      low_[v] = hn::Inf(d);
      high_[v] = hn::Neg(low_[v]);
      zero_[v] = hn::Zero(d);
    }
  }
  /// @param coordinates  of as many positions as a vector has lanes
  HWY_INLINE void add(const double* coordinates) {
    const Double_lanes d;
    for (std::size_t v = 0; v < 3; ++v) {
      const auto x = hn::LoadU(d, coordinates + v * double_lanes);
      low_[v] = hn::Min(low_[v], x);
      high_[v] = hn::Max(high_[v], x);
      zero_[v] = hn::Add(zero_[v], hn::Mul(hn::Zero(d), x));  // stays zero unless a coordinate is not finite
    }
  }
  /// Extends a box by what was added.
  /// @return 0 unless a coordinate was not finite
  HWY_INLINE double extend(double* low, double* high) const {
    const Double_lanes d;
    alignas(64) double lowest[3 * double_lanes], highest[3 * double_lanes], zeros[3 * double_lanes];
    for (std::size_t v = 0; v < 3; ++v) {
      hn::Store(low_[v], d, lowest + v * double_lanes);
      hn::Store(high_[v], d, highest + v * double_lanes);
      hn::Store(zero_[v], d, zeros + v * double_lanes);
    }
    double zero = 0;
    HWY_UNROLL(1)  // the first call waits for each cache line of its code
    for (std::size_t i = 0; i < 3 * double_lanes; i += 3) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], lowest[i + axis]);
        high[axis] = std::max(high[axis], highest[i + axis]);
        zero += zeros[i + axis];
      }
    }
    return zero;
  }

 private:
  Doubles low_[3], high_[3], zero_[3];
};

bool bound_positions_kernel(const double* coordinates, std::size_t positions, double* low, double* high) {
  Box_of_positions box;
  std::size_t position = 0;
  for (; position + double_lanes <= positions; position += double_lanes) box.add(coordinates + 3 * position);
  std::fill_n(low, 3, std::numeric_limits<double>::infinity());
  std::fill_n(high, 3, -std::numeric_limits<double>::infinity());
  double zero = box.extend(low, high);
  HWY_UNROLL(1)  // as above
  for (const double* p = coordinates + 3 * position; p != coordinates + 3 * positions; p += 3) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
      zero += 0 * p[axis];
    }
  }
  return zero == 0;
}

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

HWY_EXPORT(bound_positions_kernel);
HWY_EXPORT(sides_beyond_kernel);

bool bound_positions(const double* coordinates, std::size_t positions, double* low, double* high) {
  return HWY_DYNAMIC_DISPATCH(bound_positions_kernel)(coordinates, positions, low, high);
}

void sides_beyond(const double* coordinates, std::size_t positions, const double* low, const double* high,
                  std::uint8_t* sides) {
  HWY_DYNAMIC_DISPATCH(sides_beyond_kernel)(coordinates, positions, low, high, sides);
}

}  // namespace lodestone::kernel
#endif
