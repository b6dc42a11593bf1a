// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/check_finite.h"

#include <algorithm>
#include <cmath>

#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/faces_in_box.h"

namespace lodestone {

void fail_not_finite(std::uint32_t vertex, std::string_view title) {
  const std::string owner = title.empty() ? "" : " of " + std::string(title);
  throw Bad_mesh("vertex " + std::to_string(vertex) + owner + " has a coordinate that is not finite");
}

void check_finite(Coordinates coordinates, const std::string& title) {
  if (Box box; bound_positions(coordinates, box)) return;
  const auto wrong = std::ranges::find_if(coordinates, [](double x) { return !std::isfinite(x); });
  if (wrong != coordinates.end()) fail_not_finite(static_cast<std::uint32_t>((wrong - coordinates.begin()) / 3), title);
}

void check_finite(Coordinates coordinates, std::span<const std::uint32_t> vertices, const std::string& title) {
  for (const auto v : vertices)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!std::isfinite(coordinates[3 * std::size_t{v} + axis])) fail_not_finite(v, title);
}

}  // namespace lodestone
