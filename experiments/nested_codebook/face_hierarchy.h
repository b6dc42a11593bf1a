// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/partition/feature_vectors.h"

/// Binary hierarchies over the faces of each region of a surface, which differ only in how a node is split.
namespace lodestone {

struct Face_node {
  std::uint32_t first_face = 0, end_face = 0;  ///< places in `Face_hierarchy::faces`
  std::uint32_t second_child = 0;              ///< the first child is the next node; 0: the node is a leaf
  std::uint32_t anchor = 0;                    ///< of its vertices the one nearest to the centre of their box
  double radius = 0;                           ///< from there to the farthest of its vertices at rest
  std::vector<std::uint32_t> vertices = {};    ///< of a leaf, ascending; empty where the node is none
};

struct Face_hierarchy {
  std::vector<std::uint32_t> faces;  ///< all face indices, those of a node consecutive
  std::vector<Face_node> nodes;      ///< depth-first, one region after the other
  std::vector<std::uint32_t> roots;  ///< the topmost node of each region that has faces
};

/// A surface at rest.
struct Rest_surface {
  std::span<const Corners> corners;  ///< F >= 1
  const Positions& positions;        ///< V x 3
};

/// Divides the faces of a node in two: moves those of the first child to the front.
/// @param faces  n >= 2 face indices
/// @return the faces of the first child: 1 .. n - 1
using Face_split = std::function<std::size_t(std::span<std::uint32_t> faces)>;

/// How Tree_layout splits: at the median of the face centres along the axis on which they are spread widest, such that
/// there are as few leaves as possible. O(n) per split.
Face_split split_at_median(const Rest_surface& surface, std::size_t leaf_faces);

/// The centres of the faces, scaled to the unit ball around their mean, beside their unit normals.
/// @param normal_weight  factor of the normals; >= 0
/// @return F x 6; F x 3 if the weight is 0
Feature_vectors face_features(const Rest_surface& surface, double normal_weight);

/// A split of a nested codebook: LBG with two code vectors, over the features of the node's faces. Faces with equal
/// features are halved. O(n) per Lloyd iteration.
/// @param features  a row per face of the surface
Face_split split_by_lbg(Feature_vectors features);

/// Splits each region until no leaf has more than `leaf_faces` faces, >= 1. One split of all faces per level, and
/// O(F log F) per level for anchors.
/// @param regions  the region of each face
Face_hierarchy build_hierarchy(const Rest_surface& surface, std::span<const Region_index> regions,
                               std::size_t leaf_faces, const Face_split& split);

}  // namespace lodestone
