// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

namespace lodestone {

/// Random numbers that depend on nothing but the seed. Directions and turns also depend on the roots, sines and cosines
/// of the C library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  std::size_t below(std::size_t count) { return engine_() % count; }
  bool one_in(std::size_t count) { return below(count) == 0; }
  double number(double low = -1, double high = 1) {
    return low + (high - low) * std::ldexp(static_cast<double>(engine_() >> 11), -53);
  }
  Eigen::Vector3d vector(double size = 1) {
    const double x = number(-size, size), y = number(-size, size), z = number(-size, size);
    return {x, y, z};
  }
  /// A unit vector. The offset keeps a draw of (0, 0, 0) from being normalised.
  Eigen::Vector3d direction() { return (vector() + Eigen::Vector3d::Constant(1e-9)).normalized(); }
  Eigen::Matrix3d turn(double most) {
    const double angle = number(-most, most);
    return Eigen::AngleAxisd(angle, direction()).toRotationMatrix();
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace lodestone
