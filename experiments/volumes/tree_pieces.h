// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/tree/tree_layout.h"

/// The parts of a tree whose tightness is measured.
namespace lodestone {

/// One region of an object.
struct Region_piece {
  std::uint32_t node = 0;               ///< the highest with faces of this region only
  std::vector<std::uint32_t> faces;     ///< indices
  std::vector<std::uint32_t> vertices;  ///< indices of the vertices of the faces, ascending
};

/// Parts of one object.
struct Tree_pieces {
  std::vector<std::uint32_t> leaves;  ///< all, or `most_measured_leaves` evenly spread over the indices
  std::vector<Region_piece> regions;
};

/// Most leaves of one object that are measured.
constexpr std::size_t most_measured_leaves = 1024;

/// @param layout  built with these labels
Tree_pieces pieces_of(const Tree_layout& layout, std::span<const Corners> corners,
                      std::span<const Region_index> labels);

/// A few faces, in the form that a volume is fitted to.
struct Chosen_faces {
  std::vector<std::uint32_t> vertices;  ///< indices of the vertices of the faces, ascending
  std::vector<Leaf_corners> corners;    ///< per face: indices into `vertices`
  bool complete = true;                 ///< these are all faces of the region

  Leaf_faces posed(Coordinates coordinates) const { return {coordinates, vertices, corners}; }
};

/// Most faces that a volume is fitted to at a time.
constexpr std::size_t most_fitted_faces = 128;

/// All faces of a region, or a choice if they are more than `most_fitted_faces`.
///
/// The choice takes a face at the vertex that lies farthest in each of `most_fitted_faces` directions. The directions
/// of all k-DOPs are among them, so boxes and k-DOPs around the choice equal those around the region. Other convex
/// volumes see fewer points than the region has: balls come out a little too small, and oriented boxes may turn
/// another way.
Chosen_faces choose_faces(const Region_piece& region, std::span<const Corners> corners, Coordinates coordinates);

/// Most points of a hull. Of more points every n-th is taken; the hull of a ball comes out about 0.1 % too small.
constexpr std::size_t most_hull_points = 4096;

/// Volume of the convex hull of vertices; 0 if they are flat.
double hull_volume(Coordinates coordinates, std::span<const std::uint32_t> vertices);
/// The same of all vertices.
double hull_volume(Coordinates coordinates);

/// Volumes of the convex hulls of all pieces of some objects, each kind added up.
struct Hull_sums {
  double leaves = 0;
  double regions = 0;
  double objects = 0;
};

/// Adds the hulls of one object.
void add_hulls(const Tree_layout& layout, const Tree_pieces& pieces, Coordinates coordinates, Hull_sums& sums);

}  // namespace lodestone
