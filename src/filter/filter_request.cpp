// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter/filter_request.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "filter/face_columns.h"

namespace lodestone {

namespace {

/// A power of two, from 2^-1000 to 2^1000, that brings a size near 1 or nearer to it.
double unit_scale(double size) { return size > 0 ? std::ldexp(1.0, std::clamp(-std::ilogb(size), -1000, 1000)) : 1; }

/// Of two boxes' extents, the smaller that is not 0: no more of the larger box can overlap. 0 if both are.
double smaller_extent(const Aabb& a, const Aabb& b) {
  const auto [smaller, larger] = std::minmax({a.extent(), b.extent()});
  return std::min(smaller > 0 ? smaller : larger, std::numeric_limits<double>::max());
}

/// A leaf that spans fewer steps is rounded anew for each leaf that it meets: to read two leaves again takes about as
/// long as to test the pairs that coarser steps would leave.
constexpr double fewest_steps = 4;

/// A float that is no less than a number, and no less than 0.
float rounded_up(double number) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  if (number >= static_cast<double>(std::numeric_limits<float>::max())) return infinity;
  return number > 0 ? std::nextafter(static_cast<float>(number), infinity) : 0;
}

}  // namespace

kernel::Filter_request filter_request(const Aabb& a, const Aabb& b, double margin) {
  kernel::Filter_request request{};
  request.margin = margin;
  constexpr double most = std::numeric_limits<double>::max();
  const double extent = smaller_extent(a, b);
  request.scale = unit_scale(extent);
  request.rounded_margin = rounded_up(margin * request.scale);
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = std::max(a.low[axis], b.low[axis]);
    const double high = std::min(std::min(a.high[axis], b.high[axis]) + margin, most);
    // Scaled first: the difference could overflow.
    const double size = std::max(extent * request.scale / 1024, high * request.scale - low * request.scale);
    request.origin[axis] = std::isfinite(low) ? low : 0;
    request.steps_per_unit[axis] = size > 1e-30 ? static_cast<float>(most_steps / size) : 0;
    largest = std::max(largest, size);
  }
  request.least_side = fewest_steps / most_steps * largest / request.scale - margin;
  return request;
}

bool is_too_coarse(const kernel::Filter_request& request, const Aabb& a, const Aabb& b) {
  const auto is_short = [&](const Aabb& box) {
    return box.high[0] - box.low[0] < request.least_side && box.high[1] - box.low[1] < request.least_side &&
           box.high[2] - box.low[2] < request.least_side;
  };
  return is_short(a) || is_short(b);
}

}  // namespace lodestone
