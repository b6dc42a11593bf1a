// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/mesh/concepts.h"
#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/mesh/skinned_points.h"

/// Surfaces with joints and morph targets: read from glTF files, and subdivided.
namespace lodestone {

/// The pose of Skinned_points, to be taken by others with the same joints and targets.
struct Skin_pose {
  std::vector<Eigen::Affine3d> joints;
  std::vector<double> weights;

  /// The current pose of some points.
  static Skin_pose of(const Skinned_points& points);
  /// The same pose elsewhere.
  Skin_pose placed(const Eigen::Affine3d& placement) const;
  void give_to(Skinned_points& points) const;
};

struct Character {
  std::string name;
  Surface_mesh mesh;
  Skinned_points points;  ///< of the vertices of `mesh`, in their order
  std::vector<Skin_pose> animation = {};
};

/// What a glTF file holds, if anything in it moves.
/// @throws Bad_mesh, Bad_motion  as read_object
std::optional<Character> read_character(const std::filesystem::path& file);

/// The same shape with every edge cut into `parts` and every face into `parts`^2. New vertices lie on the old faces;
/// their weights and offsets are the means of those of the corners, as their positions are. No animation.
/// @param parts  >= 1
Character subdivided(const Character& character, std::size_t parts);

/// The number of parts whose faces come nearest to the number wanted.
std::size_t parts_for(const Character& character, std::size_t faces);

}  // namespace lodestone
