// SPDX-License-Identifier: GPL-3.0-or-later
// Two triangles: whether they intersect, by the library and by exact numbers.
#include <algorithm>
#include <vector>

#include "fuzz/triangle_truth.h"
#include "lodestone/filter/face_group_filter.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace {

using namespace lodestone::fuzz;
using lodestone::Corners;
using lodestone::Triangle;

lodestone::Aabb box_of(const Six_corners& corners, std::size_t first) {
  lodestone::Aabb box{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax({corners[first][axis], corners[first + 1][axis], corners[first + 2][axis]});
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
  if (truth && candidates.empty()) fail("the filter has discarded triangles that meet:" + text_of(corners));
  if (candidates.empty()) return;
  const bool answer =
      lodestone::triangles_intersect_given({a, a + 3, a + 6}, {b, b + 3, b + 6}, candidates[0].crossing);
  if (answer != truth) fail("the guess of the filter misleads:" + text_of(corners));
}

void check_guess(const Six_corners& corners, std::uint8_t guess, bool truth) {
  const auto at = [&](std::size_t i) { return corners[i].data(); };
  const bool answer = lodestone::triangles_intersect_given({at(0), at(1), at(2)}, {at(3), at(4), at(5)},
                                                           static_cast<lodestone::Crossing>(guess % 13));
  if (answer != truth) fail("a wrong guess gives a wrong answer:" + text_of(corners));
}

}  // namespace

LODESTONE_FUZZ_TARGET(triangles) {
  Byte_source bytes(input);
  const auto guess = bytes.byte();
  const auto corners = Triangle_drawer(bytes).draw();
  const bool truth = truly_meet(corners);
  const Triangle a = triangle(corners, 0), b = triangle(corners, 3);
  if (lodestone::triangles_intersect(a, b) != truth) fail("triangles_intersect is wrong:" + text_of(corners));
  if (lodestone::triangles_intersect(b, a) != truth) fail("the order of two triangles counts:" + text_of(corners));
  check_guess(corners, guess, truth);
  check_filter(corners, truth);
}
