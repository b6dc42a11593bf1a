// SPDX-License-Identifier: GPL-3.0-or-later
// Two triangles: whether they intersect, by the library and by exact numbers.
#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "fuzz/drawn_triangles.h"
#include "fuzz/exact_triangles.h"
#include "lodestone/filter/face_group_filter.h"
#include "lodestone/triangles/triangle_distance.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace {

using namespace lodestone::fuzz;
using lodestone::Corners;
using lodestone::Point;
using lodestone::Triangle;

// ---- The truth ----

template <class Number, class Convert>
bool meet(const Six_corners& corners, const Convert& convert) {
  typename Exact_triangles<Number>::Triangle triangles[2];
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) triangles[i / 3][i % 3][axis] = convert(corners[i][axis]);
  return Exact_triangles<Number>::meet(triangles[0], triangles[1]);
}

/// The least power of two by which all coordinates become integers, unless one of them is then so large that a
/// determinant would not fit into 64 bits.
std::optional<int> exponent_to_integers(const Six_corners& corners) {
  constexpr int most_bits = 18;
  int lowest = 0, highest = -2000;
  for (const auto& corner : corners)
    for (const double coordinate : corner) {
      if (coordinate == 0) continue;
      int exponent = 0;
      auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(coordinate, &exponent), 53));
      exponent -= 53;
      while (mantissa % 2 == 0) mantissa /= 2, ++exponent;
      lowest = std::min(lowest, exponent);
      highest = std::max(highest, std::ilogb(coordinate) + 1);
    }
  if (highest - lowest > most_bits) return std::nullopt;
  return -lowest;
}

bool truly_meet(const Six_corners& corners) {
  if (const auto exponent = exponent_to_integers(corners))
    return meet<std::int64_t>(corners, [&](double x) { return static_cast<std::int64_t>(std::ldexp(x, *exponent)); });
  return meet<CGAL::Exact_rational>(corners, [](double x) { return CGAL::Exact_rational(x); });
}

// ---- The library ----

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

lodestone::Aabb box_of(const Six_corners& corners, std::size_t first) {
  lodestone::Aabb box{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] =
        std::minmax({corners[first][axis], corners[first + 1][axis], corners[first + 2][axis]});
    box.low[axis] = low, box.high[axis] = high;
  }
  return box;
}

/// Vectorised filters may only discard triangles that are apart. Their guess must not mislead the exact test.
void check_filter(const Six_corners& corners, bool truth) {
  static lodestone::Face_group_filter filter;
  static const std::vector<Corners> face{{0, 1, 2}};
  const auto* const a = corners[0].data();
  const auto* const b = corners[3].data();
  filter.begin({a, 9}, box_of(corners, 0), {b, 9}, box_of(corners, 3));
  const auto candidates = filter.face_candidates(face, face);
  require(!truth || candidates.size() == 1, "the filter has discarded triangles that meet:" + text_of(corners));
  if (candidates.empty()) return;
  const bool answer = lodestone::triangles_intersect_given({a, a + 3, a + 6}, {b, b + 3, b + 6}, candidates[0].crossing);
  require(answer == truth, "the guess of the filter misleads:" + text_of(corners));
}

void check_guess(const Six_corners& corners, std::uint8_t guess, bool truth) {
  const auto at = [&](std::size_t i) { return corners[i].data(); };
  const bool answer = lodestone::triangles_intersect_given({at(0), at(1), at(2)}, {at(3), at(4), at(5)},
                                                           static_cast<lodestone::Crossing>(guess % 13));
  require(answer == truth, "a wrong guess gives a wrong answer:" + text_of(corners));
}

/// Slower functions that answer the same question on the way.
void check_constructions(const Six_corners& corners, bool truth) {
  const Triangle a = triangle(corners, 0), b = triangle(corners, 3);
  require(lodestone::triangles_nearer_than(a, b, 0) == truth, "triangles_nearer_than 0 is wrong:" + text_of(corners));
  require(!lodestone::triangle_intersection(a, b).empty() == truth, "triangle_intersection is wrong:" + text_of(corners));
  const auto closest = lodestone::closest_points(a, b);
  require((closest.distance == 0) == truth, "closest_points is wrong:" + text_of(corners));
}

}  // namespace

LODESTONE_FUZZ_TARGET(triangles) {
  Byte_source bytes(input);
  const auto asked = bytes.byte();
  const auto corners = Triangle_drawer(bytes).draw();
  const bool truth = truly_meet(corners);
  const Triangle a = triangle(corners, 0), b = triangle(corners, 3);
  require(lodestone::triangles_intersect(a, b) == truth, "triangles_intersect is wrong:" + text_of(corners));
  require(lodestone::triangles_intersect(b, a) == truth, "the order of two triangles counts:" + text_of(corners));
  check_guess(corners, asked / 16, truth);
  check_filter(corners, truth);
  if (asked % 16 == 15) check_constructions(corners, truth);
}
