// SPDX-License-Identifier: GPL-3.0-or-later
// Two moving triangles: they do not meet before their first impact, and do at it, where those times are simple numbers.
// Whether they meet at a time is decided by exact integers, without the library.
#include "lodestone/triangles/impact.h"

#include <cmath>
#include <optional>

#include "fuzz/triangle_truth.h"

namespace lodestone::fuzz {

namespace {

constexpr int steps = 8;

/// Eight times the position at t = step / 8, unless it would be rounded.
std::optional<double> scaled_position(double start, double end, int step) {
  const double from = start * (steps - step), to = end * step, sum = from + to;
  // The errors of both products and of the sum.
  const double of_to = sum - from, rest = (from - (sum - of_to)) + (to - of_to);
  if (std::fma(start, steps - step, -from) != 0 || std::fma(end, step, -to) != 0 || rest != 0) return std::nullopt;
  return sum;
}

std::optional<Six_corners> corners_at(const Six_corners& start, const Six_corners& end, int step) {
  Six_corners corners{};
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto position = scaled_position(start[i][axis], end[i][axis], step);
      if (!position) return std::nullopt;
      corners[i][axis] = *position;
    }
  return corners;
}

std::optional<double> time_of(const std::optional<Impact_time>& impact) {
  return impact ? std::optional(impact->value()) : std::nullopt;
}

}  // namespace

}  // namespace lodestone::fuzz

LODESTONE_FUZZ_TARGET(impact) {
  using namespace lodestone::fuzz;
  Byte_source bytes(input);
  const auto start = Triangle_drawer(bytes).draw();
  auto end = Triangle_drawer(bytes).draw();
  for (std::size_t i = 0; i < end.size(); ++i)
    if (bytes.below(4) == 1) end[i] = start[i];
  const auto expect = [&](bool holds, const char* wrong) {
    if (!holds) fail(wrong + text_of(start) + " moves to " + text_of(end));
  };

  const lodestone::Moving_triangle a{triangle(start, 0), triangle(end, 0)}, b{triangle(start, 3), triangle(end, 3)};
  const auto impact = lodestone::first_impact(a, b);
  expect(time_of(lodestone::first_impact(b, a)) == time_of(impact), "the order of the triangles matters:");
  if (impact) {
    const auto again = lodestone::first_impact(a, b, impact->high());
    expect(again && *again == *impact, "an impact is not found until its own time:");
    expect(!lodestone::first_impact_before(*impact, b, a), "an impact is found before itself:");
    expect(lodestone::first_impact_until(*impact, b, a) == impact, "an impact is not found until itself:");
    if (impact->low() > 0)
      expect(!lodestone::first_impact(a, b, std::nextafter(impact->low(), 0)), "an impact is found before its time:");
  }
  if (const auto limit = lodestone::first_impact({a.end, a.start}, {b.end, b.start})) {
    const auto before = lodestone::first_impact_before(*limit, a, b);
    expect(before == (impact && *impact < *limit ? impact : std::nullopt), "an impact before a time is another one:");
    const auto until = lodestone::first_impact_until(*limit, a, b);
    expect(until == (impact && *impact <= *limit ? impact : std::nullopt), "an impact until a time is another one:");
  }
  for (int step = 0; step <= steps; ++step) {
    const double t = static_cast<double>(step) / steps;
    const bool is_impact = impact && impact->low() == t && impact->high() == t;
    if (!is_impact && impact && impact->high() <= t) break;
    const auto corners = corners_at(start, end, step);
    if (corners) expect(truly_meet(*corners) == is_impact, "triangles meet before their impact, or not at it:");
  }
}
