// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "lodestone/mesh/concepts.h"
#include "lodestone/mesh/pairs.h"

namespace lodestone {

/// What CGAL reports: pairs of different faces, sorted, and how many pairs of a face with itself.
struct Cgal_self_intersections {
  std::vector<Face_pair> pairs;
  std::size_t zero_area_faces = 0;
};

Cgal_self_intersections cgal_self_intersections(const Surface_mesh& mesh);

/// The pairs of a mesh without zero-area faces. Fails the test if there are any.
std::vector<Face_pair> self_intersections_by_cgal(const Surface_mesh& mesh);

}  // namespace lodestone
