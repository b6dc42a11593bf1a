// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// A surface whose seams are closed: vertices on open borders that lie at the same place are joined to one.
///
/// Exporters double vertices where normals or texture coordinates jump: along seams, or all three of every triangle.
/// Only what walks along the surface uses the closed seams. The faces keep their own corners, which may part later.
struct Closed_seams {
  std::vector<std::uint32_t> vertices;  ///< W: the lowest mesh vertex of each place, ascending
  std::vector<std::uint32_t> index;     ///< V: per mesh vertex the entry of `vertices` that it is joined to
  std::vector<Corners> corners;         ///< F: the corners of the faces, as entries of `vertices`

  /// The mesh vertex that stands for mesh vertex v.
  std::uint32_t joined(std::uint32_t v) const { return vertices[index[v]]; }
  /// Number of mesh vertices that are joined to another one.
  std::size_t joined_count() const { return index.size() - vertices.size(); }
};

/// Joins vertices with equal coordinates. The corners of a face are never joined, so that every face keeps three; at
/// their place nothing is. O(V log V + F).
/// @param faces      F, of a mesh with V vertices
/// @param on_border  V: see `open_border`
/// @param positions  V x 3
/// @return none if no vertices are joined
std::optional<Closed_seams> close_seams(std::span<const Corners> faces, const std::vector<bool>& on_border,
                                        const Positions& positions);

/// Joins the vertices that are said to be. O(V + F).
/// @param joined  V: per mesh vertex the one that stands for it, as `Closed_seams::joined` gives it
/// @return none if there are no such seams: each vertex must stand for itself or be joined to a lower one that does,
///         and the corners of a face must stay three
std::optional<Closed_seams> seams_of(std::span<const Corners> faces, std::span<const std::uint32_t> joined);

}  // namespace lodestone
