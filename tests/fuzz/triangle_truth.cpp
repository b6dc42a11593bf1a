// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/triangle_truth.h"

#include <CGAL/Exact_integer.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "fuzz/exact_triangles.h"
#include "fuzz/wide_integer.h"

namespace lodestone::fuzz {

namespace {

template <class Number, class Convert>
bool meet(const Six_corners& corners, const Convert& convert) {
  typename Exact_triangles<Number>::Triangle triangles[2];
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) triangles[i / 3][i % 3][axis] = convert(corners[i][axis]);
  return Exact_triangles<Number>::meet(triangles[0], triangles[1]);
}

/// A double as an odd integer, or zero, times a power of two.
struct Odd {
  std::int64_t factor = 0;
  int exponent = 0;

  explicit Odd(double value) {
    if (value == 0) return;
    factor = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
    exponent -= 53;
    while (factor % 2 == 0) factor /= 2, ++exponent;
  }
};

/// From the lowest to the highest bit of all coordinates.
struct Bits {
  int lowest = 2000, end = -2000;

  explicit Bits(const Six_corners& corners) {
    for (const auto& corner : corners)
      for (const double coordinate : corner) {
        if (coordinate == 0) continue;
        lowest = std::min(lowest, Odd(coordinate).exponent);
        end = std::max(end, std::ilogb(coordinate) + 1);
      }
  }
  int count() const { return end - lowest; }
};

}  // namespace

bool truly_meet(const Six_corners& corners) {
  const Bits bits(corners);
  // A determinant has three factors, which are differences, and six terms.
  if (bits.count() <= 18)
    return meet<std::int64_t>(corners,
                              [&](double x) { return static_cast<std::int64_t>(std::ldexp(x, -bits.lowest)); });
  if (bits.count() <= 80)
    return meet<Wide_integer>(corners, [&](double x) {
      const Odd odd(x);
      return Wide_integer(odd.factor)
          .shifted(odd.factor == 0 ? 0 : static_cast<std::size_t>(odd.exponent - bits.lowest));
    });
  return meet<CGAL::Exact_integer>(corners, [&](double x) -> CGAL::Exact_integer {
    const Odd odd(x);
    return CGAL::Exact_integer(static_cast<double>(odd.factor)) << (odd.factor == 0 ? 0 : odd.exponent - bits.lowest);
  });
}

Triangle triangle(const Six_corners& corners, std::size_t first) {
  Triangle result;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& [x, y, z] = corners[first + i];
    result[i] = Point(x, y, z);
  }
  return result;
}

std::string text_of(const Six_corners& corners) {
  std::string text;
  char number[40];
  for (const auto& corner : corners)
    for (const double coordinate : corner) {
      std::snprintf(number, sizeof number, " %a", coordinate);
      text += number;
    }
  return text;
}

}  // namespace lodestone::fuzz
