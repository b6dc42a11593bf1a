// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/tree/tree_layout.h"

/// Which parts of a tree its tightness is measured on.
namespace lodestone {

/// One region of an object.
struct Region_piece {
  std::uint32_t node = 0;               ///< the highest with faces of this region only
  std::vector<std::uint32_t> faces;     ///< their numbers
  std::vector<std::uint32_t> vertices;  ///< numbers of those that the faces have, ascending
};

/// Parts of one object.
struct Tree_pieces {
  std::vector<std::uint32_t> leaves;  ///< all, or so many of them, evenly spread over their numbers
  std::vector<Region_piece> regions;
};

/// Most leaves of one object that are measured.
constexpr std::size_t most_measured_leaves = 1024;

/// @param layout  built with these labels
Tree_pieces pieces_of(const Tree_layout& layout, std::span<const Corners> corners,
                      std::span<const Region_index> labels);

/// A few faces in the form in which a volume is fitted to them.
struct Chosen_faces {
  std::vector<std::uint32_t> vertices;  ///< numbers of those that the faces have, ascending
  std::vector<Leaf_corners> corners;    ///< per face: places in `vertices`
  bool complete = true;                 ///< these are all faces of the region

  Leaf_faces posed(Coordinates coordinates) const { return {coordinates, vertices, corners}; }
};

/// A volume is fitted to at most so many faces at a time.
constexpr std::size_t most_fitted_faces = 128;

/// All faces of a region; if they are too many, for each of so many directions a face with a vertex that lies farthest
/// that way. Among the directions are those of all k-DOPs, so boxes and k-DOPs around these faces are those around the
/// region. Other convex volumes are fitted to fewer points than they would be: balls around them are a little too
/// small, boxes that turn may turn another way.
Chosen_faces choose_faces(const Region_piece& region, std::span<const Corners> corners, Coordinates coordinates);

/// A hull of more points is that of every n-th of them, which makes that of a ball too small by a thousandth or so.
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
