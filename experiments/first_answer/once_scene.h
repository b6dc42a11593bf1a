// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lodestone/mesh/concepts.h"

namespace lodestone {

/// Two spheres of nearly equal triangles, the second of which creeps on from frame to frame.
struct Once_scene {
  std::string name;
  std::size_t triangles = 0;  ///< of each
  Surface_mesh a, b;

  /// Moves the second by a small part of a triangle.
  void step();
};

/// Where the second sphere is, and in which size.
struct Once_kind {
  std::string name;
  Kernel::Vector_3 centre;  ///< of the second, in radii of the first, whose centre is the origin
  double size;              ///< of the second, in those of the first
};
/// Far apart; beside each other, so that their boxes overlap, but they do not; overlapping by half a percent, a tenth
/// and 85 % of the diameter; the second inside the first.
const std::vector<Once_kind>& once_kinds();

/// Frequencies of the icospheres: 20 frequency^2 triangles.
struct Once_size {
  std::size_t frequency;
  bool published;  ///< measured unless others are asked for
  std::size_t triangles() const { return 20 * frequency * frequency; }
};
const std::vector<Once_size>& once_sizes();
/// Each size once, the smallest first.
std::vector<Once_size> in_order(std::vector<Once_size> sizes);

Once_scene make_once_scene(const Once_kind& kind, const Once_size& size);

}  // namespace lodestone
