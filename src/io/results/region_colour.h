// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "lodestone/mesh/concepts.h"

namespace lodestone {

using Colour = std::array<std::uint8_t, 3>;

/// sRGB colour of a region. Hues advance by the golden section, so consecutive regions get clearly different hues.
inline Colour region_colour(Region_index region) {
  const double hue = 6 * std::fmod(0.61803398874989485 * region, 1.0);
  const double lightness = 0.75 + 0.2 * static_cast<double>(region % 3) / 2;
  const auto channel = [&](double offset) {
    const double distance = std::abs(std::fmod(hue + offset, 6.0) - 3) - 1;
    return static_cast<std::uint8_t>(std::lround(255 * lightness * (0.25 + 0.75 * std::clamp(distance, 0.0, 1.0))));
  };
  return {channel(0), channel(4), channel(2)};
}

}  // namespace lodestone
