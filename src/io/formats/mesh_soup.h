// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// Points and triangles as a file lists them: vertex and face indices are the file's own, from 0.
struct Mesh_soup {
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> faces;
};

/// Its faces in a form that takes little memory.
std::vector<Corners> corners_of(const Mesh_soup& soup);

}  // namespace lodestone
