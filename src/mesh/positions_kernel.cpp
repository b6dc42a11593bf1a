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

/// Coordinates of as many positions as a vector has lanes.
constexpr std::size_t block = 3 * double_lanes;

/// Of three vectors of coordinates in turn: then each lane holds one axis only, x, y or z by its number modulo 3.
struct Extremes {
  alignas(64) double low[block], high[block];
  alignas(64) double zero[block];  ///< 0 unless a coordinate was not finite
};

/// How far on a block begins at a multiple of a vector's size: there no vector lies in two cache lines, which would
/// take twice as long to load.
/// @return in coordinates, less than a block
HWY_INLINE std::size_t to_whole_lines(const double* coordinates) {
  static_assert(8 % double_lanes == 0);
  const std::size_t lane = reinterpret_cast<std::uintptr_t>(coordinates) / sizeof(double) % double_lanes;
  return 3 * ((double_lanes - lane) * 3 % double_lanes);  // 3 * 3 is 1 modulo 8
}

/// @param count  of the coordinates, a multiple of three: at least a block
HWY_INLINE void find_extremes(const double* coordinates, std::size_t count, Extremes& extremes) {
  const Double_lanes d;
  Doubles low0 = hn::Inf(d), low1 = low0, low2 = low0;
  Doubles high0 = hn::Neg(low0), high1 = high0, high2 = high0;
  Doubles zero0 = hn::Zero(d), zero1 = zero0, zero2 = zero0;  // stay zero unless a coordinate is not finite
  const auto add = [&](const double* from, auto& low, auto& high, auto& zero) HWY_ATTR {
    const auto x = hn::LoadU(d, from);
    low = hn::Min(low, x);
    high = hn::Max(high, x);
    zero = hn::MulAdd(hn::Zero(d), x, zero);
  };
  // Blocks may overlap: the second begins at a whole line, the last one ends where the coordinates do.
  const double* const last = coordinates + count - block;
  const std::size_t first_step = to_whole_lines(coordinates);
  for (std::size_t step = first_step == 0 ? block : first_step;; step = block) {
    add(coordinates, low0, high0, zero0);
    add(coordinates + double_lanes, low1, high1, zero1);
    add(coordinates + 2 * double_lanes, low2, high2, zero2);
    if (coordinates == last) break;
    coordinates = std::min(coordinates + step, last);
  }
  const auto store = [&](const auto& v0, const auto& v1, const auto& v2, double* to) HWY_ATTR {
    hn::Store(v0, d, to);
    hn::Store(v1, d, to + double_lanes);
    hn::Store(v2, d, to + 2 * double_lanes);
  };
  store(low0, low1, low2, extremes.low);
  store(high0, high1, high2, extremes.high);
  store(zero0, zero1, zero2, extremes.zero);
}

/// Extends a box by some of the coordinates.
/// @param count  a multiple of three
/// @return 0 unless a coordinate is not finite
HWY_INLINE double extend(double* low, double* high, const double* lowest, const double* highest, const double* zeros,
                         std::size_t count) {
  double zero = 0;
  HWY_UNROLL(1)  // the first call waits for each cache line of its code
  for (std::size_t i = 0; i < count; i += 3) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], lowest[i + axis]);
      high[axis] = std::max(high[axis], highest[i + axis]);
      zero += 0 * zeros[i + axis];
    }
  }
  return zero;
}

bool bound_positions_kernel(const double* coordinates, std::size_t positions, double* low, double* high) {
  std::fill_n(low, 3, std::numeric_limits<double>::infinity());
  std::fill_n(high, 3, -std::numeric_limits<double>::infinity());
  if (positions < double_lanes) return extend(low, high, coordinates, coordinates, coordinates, 3 * positions) == 0;
  Extremes extremes;
  find_extremes(coordinates, 3 * positions, extremes);
  return extend(low, high, extremes.low, extremes.high, extremes.zero, block) == 0;
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
