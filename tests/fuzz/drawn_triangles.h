// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs of triangles that often touch, or just miss each other.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "fuzz/byte_source.h"

namespace lodestone::fuzz {

using Coordinate_point = std::array<double, 3>;
/// Three corners of one triangle, then three of the other.
using Six_corners = std::array<Coordinate_point, 6>;

/// Draws the corners one after the other, the later ones mostly from those before.
class Triangle_drawer {
 public:
  explicit Triangle_drawer(Byte_source& bytes) : bytes_(bytes) {}

  Six_corners draw() {
    Six_corners corners{};
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = next_corner(corners, i);
    transform(corners);
    return corners;
  }

 private:
  Coordinate_point next_corner(const Six_corners& earlier, std::size_t count) {
    const auto choice = count == 0 ? 0 : bytes_.below(16);
    const auto one_of = [&] { return earlier[bytes_.below(count)]; };
    if (choice == 10) return one_of();
    if (choice == 11) return nudged(one_of());
    if (choice == 12) return between(one_of(), one_of());
    if (choice == 13) return nudged(between(one_of(), one_of()));
    if (choice >= 14 && count >= 3) return in_plane(earlier);
    return {bytes_.coordinate(), bytes_.coordinate(), bytes_.coordinate()};
  }
  /// A unit in the last place along one axis.
  Coordinate_point nudged(Coordinate_point p) {
    const auto choice = bytes_.byte();
    auto& coordinate = p[choice % 3];
    coordinate = std::nextafter(coordinate, choice < 128 ? -HUGE_VAL : HUGE_VAL);
    return finite(p);
  }
  /// On the line through two points, rounded; mostly between them.
  Coordinate_point between(const Coordinate_point& p, const Coordinate_point& q) {
    const double t = (static_cast<double>(bytes_.below(13)) - 2) / 8;
    Coordinate_point result{};
    for (std::size_t axis = 0; axis < 3; ++axis) result[axis] = p[axis] + t * (q[axis] - p[axis]);
    return finite(result);
  }
  /// In the plane of the first triangle, rounded.
  Coordinate_point in_plane(const Six_corners& corners) {
    const double u = (static_cast<double>(bytes_.below(13)) - 4) / 4,
                 v = (static_cast<double>(bytes_.below(13)) - 4) / 4;
    Coordinate_point result{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      result[axis] =
          corners[0][axis] + u * (corners[1][axis] - corners[0][axis]) + v * (corners[2][axis] - corners[0][axis]);
    return finite(result);
  }
  /// Makes all of it tiny or huge, or takes it far from the origin.
  void transform(Six_corners& corners) {
    const auto choice = bytes_.byte();
    if (choice < 192) return;
    const int exponent = static_cast<int>(bytes_.byte()) * 8 - 1064;
    const double offset = choice >= 224 ? std::ldexp(1.0, static_cast<int>(bytes_.below(64))) : 0;
    for (auto& corner : corners) {
      for (auto& coordinate : corner)
        coordinate = choice >= 224 ? coordinate + offset : std::ldexp(coordinate, exponent);
      corner = finite(corner);
    }
  }
  static Coordinate_point finite(Coordinate_point p) {
    for (auto& coordinate : p)
      if (!std::isfinite(coordinate)) coordinate = 1;
    return p;
  }

  Byte_source& bytes_;
};

}  // namespace lodestone::fuzz
