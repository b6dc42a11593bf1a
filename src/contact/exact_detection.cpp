// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/contact/exact_detection.h"

namespace lodestone {

Positions scaled_positions(Coordinates coordinates) {
  double largest = 0;
  for (const double x : coordinates) largest = std::max(largest, std::abs(x));
  int exponent = 0;
  std::frexp(largest, &exponent);
  Positions positions(static_cast<Eigen::Index>(coordinates.size() / 3), 3);
  std::transform(coordinates.begin(), coordinates.end(), positions.data(),
                 [exponent](double x) { return std::ldexp(x, -exponent); });
  return positions;
}

void check_finite(Coordinates coordinates, std::uint32_t object) {
  const auto wrong = std::ranges::find_if(coordinates, [](double x) { return !std::isfinite(x); });
  if (wrong == coordinates.end()) return;
  throw Bad_mesh("vertex " + std::to_string((wrong - coordinates.begin()) / 3) + " of object " +
                 std::to_string(object) + " has a coordinate that is not finite");
}

}  // namespace lodestone
