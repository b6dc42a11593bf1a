// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "lodestone/triangles/crossing.h"

namespace lodestone {

/// Two faces by their places in the lists of their leaves.
struct Face_candidate {
  std::uint8_t a = 0;
  std::uint8_t b = 0;
  Crossing crossing = no_crossing;
  std::uint8_t unused = 0;  ///< so that a vector can write several
};

}  // namespace lodestone
