// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "lodestone/triangles/crossing.h"

namespace lodestone {

/// Two faces, one of each of two leaves, that may meet.
struct Face_candidate {
  std::uint8_t a = 0;               ///< index in the first leaf
  std::uint8_t b = 0;               ///< index in the second leaf
  Crossing crossing = no_crossing;  ///< a guess at how they intersect, for the exact test
  std::uint8_t unused = 0;          ///< padding: a vector writes several candidates at once
};

}  // namespace lodestone
