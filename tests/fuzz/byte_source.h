// SPDX-License-Identifier: GPL-3.0-or-later
// Turns bytes into numbers and choices.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>

#include "fuzz/target.h"

namespace lodestone::fuzz {

/// Numbers from bytes, from front to back. Behind the end all bytes are zero, so every input means something.
class Byte_source {
 public:
  explicit Byte_source(Input bytes) : left_(bytes) {}

  bool empty() const { return left_.empty(); }
  Input rest() const { return left_; }

  std::uint8_t byte() { return number<std::uint8_t>(); }
  /// From 0 to limit - 1, limit from 1 to 256.
  std::size_t below(std::size_t limit) { return byte() % limit; }
  bool flag() { return (byte() & 1U) != 0; }

  template <class Number>
  Number number() {
    Number value{};
    const auto size = std::min(sizeof(Number), left_.size());
    if (size > 0) std::memcpy(&value, left_.data(), size);
    left_ = left_.subspan(size);
    return value;
  }

  /// A coordinate that often equals another one or lies just beside it: of a small lattice, a lattice point nudged by a
  /// unit in the last place, a power of two, or any finite double.
  double coordinate() {
    const auto choice = byte();
    const double lattice = static_cast<double>(choice % 8) - 3;
    switch (choice >> 3U) {
      case 27:
        return std::nextafter(lattice, 8);
      case 28:
        return std::nextafter(lattice, -8);
      case 29:
        return lattice / 3;
      case 30:
        return std::ldexp(lattice, static_cast<int>(byte()) * 8 - 1064);
      case 31:
        return finite(number<double>());
      default:
        return lattice;
    }
  }

 private:
  static double finite(double any) { return std::isfinite(any) ? any : 0; }

  Input left_;
};

}  // namespace lodestone::fuzz
