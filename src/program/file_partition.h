// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lodestone/io/formats/joined_vertices.h"
#include "lodestone/io/motion/animation.h"
#include "lodestone/mesh/indexed_mesh.h"
#include "lodestone/partition/partition_measures.h"
#include "lodestone/partition/strategies.h"

namespace lodestone {

/// One frame of a file, by the vertices of the file.
struct File_surface {
  std::vector<double> coordinates;  ///< 3 V
  std::vector<Corners> faces;       ///< F
  Joined_vertices joined;           ///< V, or empty
};

/// @param animation  with faces
/// @throws Bad_motion  the frame is broken
File_surface file_surface(const Animation& animation, std::size_t frame);

/// Turns faces whose neighbours have the other orientation, as the reader of meshes does. The faces of an object of a
/// scene are so already.
void orient(File_surface& surface);

/// The vertices of a file, divided into regions. The copies that a half-edge mesh has of a vertex that is not manifold
/// are one vertex here, so labels, sizes and particles agree with each other.
struct File_partition {
  std::vector<Region_index> labels;   ///< V. A vertex that no face names has the label of the one that it is joined
                                      ///< to, else 0
  std::vector<std::size_t> sizes;     ///< per region: vertices that faces name
  Partition<Indexed_mesh> partition;  ///< its particles are vertices of the file
  Partition_measures measures;
  double seconds = 0;  ///< that dividing took
};

/// @throws Bad_mesh, Bad_argument  as `partition`
File_partition divide(const File_surface& surface, std::size_t regions, const Any_strategy& strategy,
                      const Partition_options& options = {});

}  // namespace lodestone
