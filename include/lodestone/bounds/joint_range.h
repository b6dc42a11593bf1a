// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

namespace lodestone {

/// How one joint moves the vertices of a node of a tree.
struct Joint_range {
  std::array<double, 3> low;   ///< of the box at rest around the vertices with a weight above 0
  std::array<double, 3> high;  ///< of the same box
  double least;                ///< weight among the vertices
  double greatest;             ///< the same
  std::uint32_t joint;         ///< of the skin
};

}  // namespace lodestone
