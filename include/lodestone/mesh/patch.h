// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/box.h"
#include "lodestone/mesh/check_finite.h"
#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/mesh/vertex_graph.h"

namespace lodestone {

/// A set of faces, with the vertices that they use listed once.
struct Patch {
  std::vector<std::uint32_t> faces = {};     ///< face indices in the mesh, ascending
  std::vector<std::uint32_t> vertices = {};  ///< vertex indices in the mesh, ascending
  std::vector<Corners> corners = {};         ///< per face: its corners as indices into `vertices`
};

/// The patch of the given faces. Cost O(n log n).
/// @param mesh_corners  corners of every face of the mesh
Patch make_patch(std::vector<std::uint32_t> faces, std::span<const Corners> mesh_corners);

/// The faces of each region: those with at least one corner in it. A face at the border of regions belongs to two
/// or three, so no face is lost between regions. O(V + F + B log B), with B faces at borders of regions.
std::vector<Patch> region_patches(std::span<const Corners> mesh_corners, std::span<const Region_index> labels,
                                  std::size_t regions);

/// A patch with the positions of its vertices in the current frame.
struct Posed_patch {
  const Patch* patch = nullptr;            ///< must outlive this
  std::vector<Eigen::Vector3d> positions;  ///< parallel to `patch->vertices`
  Box box;                                 ///< around the positions
  std::uint64_t frame = 0;                 ///< the frame of these positions; 0: none yet
};

/// Reads the positions of a patch, unless it already holds those of `frame`. O(vertices of the patch).
/// @throws Bad_mesh  a coordinate is not finite
template <class Reader>
void pose_patch(Posed_patch& posed, const Reader& reader, std::uint64_t frame) {
  if (posed.frame == frame) return;
  posed.box.setEmpty();
  posed.positions.resize(posed.patch->vertices.size());
  Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < posed.positions.size(); ++i) {
    posed.positions[i] = reader(posed.patch->vertices[i]);
    posed.box.extend(posed.positions[i]);
    zero += 0 * posed.positions[i];  // stays zero unless a coordinate is not finite
  }
  if (!zero.isZero(0))
    for (std::size_t i = 0; i < posed.positions.size(); ++i)
      if (!posed.positions[i].allFinite()) fail_not_finite(posed.patch->vertices[i]);
  posed.frame = frame;
}

}  // namespace lodestone
