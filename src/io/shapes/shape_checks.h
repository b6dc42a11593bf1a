// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string_view>
#include <vector>

#include "lodestone/mesh/concepts.h"
#include "lodestone/mesh/errors.h"

/// Argument checks and welding for the built-in shapes.
namespace lodestone::detail {

inline constexpr std::size_t max_shape_faces = 50'000'000;

inline void check_count(std::string_view shape, std::string_view what, std::size_t value, std::size_t least) {
  if (value < least) throw Bad_argument(fmt::format("{}: {} is {}, must be >= {}", shape, what, value, least));
}

/// Refuses more than the limit of `per_cell * a * b` faces, without overflow.
inline void check_faces(std::string_view shape, std::size_t per_cell, std::size_t a, std::size_t b) {
  if (a > max_shape_faces / per_cell / b)
    throw Bad_argument(fmt::format("{}: {} x {} gives more than {} triangles", shape, a, b, max_shape_faces));
}

inline void check_length(std::string_view shape, std::string_view what, double value) {
  if (!(value > 0 && std::isfinite(value)))
    throw Bad_argument(fmt::format("{}: {} is {}, must be positive and finite", shape, what, value));
}

/// Points indexed in order of first use; equal coordinates get the same index.
class Welded_points {
 public:
  std::size_t number(const Point& p) {
    const auto [entry, added] = numbers_.try_emplace({p.x(), p.y(), p.z()}, points_.size());
    if (added) points_.push_back(p);
    return entry->second;
  }
  const std::vector<Point>& points() const { return points_; }

 private:
  std::map<std::array<double, 3>, std::size_t> numbers_;
  std::vector<Point> points_;
};

using Triangle_numbers = std::array<std::size_t, 3>;

}  // namespace lodestone::detail
