// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/check_finite.h"

#include <algorithm>
#include <cmath>

#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/faces_in_box.h"

namespace lodestone {

namespace {

[[noreturn]] void fail_not_finite(std::size_t vertex, const std::string& title) {
  throw Bad_mesh("vertex " + std::to_string(vertex) + " of " + title + " has a coordinate that is not finite");
}

}  // namespace

void check_finite(Coordinates coordinates, const std::string& title) {
  if (Box box; bound_positions(coordinates, box)) return;
  const auto wrong = std::ranges::find_if(coordinates, [](double x) { return !std::isfinite(x); });
  if (wrong != coordinates.end()) fail_not_finite(static_cast<std::size_t>(wrong - coordinates.begin()) / 3, title);
}

void check_finite(Coordinates coordinates, std::span<const std::uint32_t> vertices, const std::string& title) {
  for (const std::size_t v : vertices)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!std::isfinite(coordinates[3 * v + axis])) fail_not_finite(v, title);
}

}  // namespace lodestone
