// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>

namespace lodestone {

/// Scales differences of coordinates by a power of two, so that their squares neither overflow nor underflow. A
/// difference is rounded once; apart from that, only differences below 2^-1000 of the largest lose digits.
class Scale {
 public:
  /// @param largest  largest difference or length, rounded, > 0, may be infinite; it is scaled to between 2^-24 and 4
  explicit Scale(double largest)
      : before_(largest > 0x1p1000 ? -8 : 0), after_(before_ == 0 ? -std::ilogb(largest) : -1024 - before_) {}

  double difference(double x, double y) const {
    return std::scalbn(std::scalbn(x, before_) - std::scalbn(y, before_), after_);
  }
  double length(double x) const { return std::scalbn(x, before_ + after_); }
  /// x plus a scaled difference.
  double moved(double x, double difference) const {
    return std::scalbn(std::scalbn(x, before_) + std::scalbn(difference, -after_), -before_);
  }
  /// Upper bound of a length, from its scaled value.
  double length_above(double scaled) const {
    return std::nextafter(std::scalbn(scaled, -before_ - after_), std::numeric_limits<double>::infinity());
  }

 private:
  int before_;  ///< exponent applied before a subtraction, so that it does not overflow
  int after_;   ///< exponent applied after it
};

}  // namespace lodestone
