// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// Points and triangles in the order of the file: vertex and face indices are those of the file, from 0.
struct Mesh_soup {
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> faces;
};

/// The faces of a soup in compact form.
std::vector<Corners> corners_of(const Mesh_soup& soup);

}  // namespace lodestone
