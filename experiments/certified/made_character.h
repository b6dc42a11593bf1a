// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "certified/capsule_surface.h"

/// Characters that the experiment makes from capsules, and writes as glTF files.
namespace lodestone {

/// A joint that swings about an axis: its angle is middle + swing sin(2 pi (turns t + phase)), where t goes from 0 to 1
/// over the animation.
struct Made_joint {
  std::string name;
  std::size_t parent = 0;  ///< of the first: itself
  Eigen::Vector3d at;      ///< at rest
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();
  double middle = 0, swing = 0;  ///< in radians
  double turns = 1, phase = 0;
};

/// A morph target: vertices within `reach` of `centre` move by up to `offset`. Its weight is (1 + sin(2 pi (turns t +
/// phase))) / 2.
struct Made_target {
  std::string name;
  Eigen::Vector3d centre;
  double reach = 1;
  Eigen::Vector3d offset;
  double turns = 1, phase = 0;

  Eigen::Vector3d offset_at(const Eigen::Vector3d& point) const;
};

struct Made_character {
  std::string name = {};
  std::vector<Capsule> capsules = {};
  Capsule_surface_options surface = {};
  std::vector<Made_joint> joints = {};  ///< each after its parent; empty: no skin
  double blend = 0.1;                   ///< how far from its border a joint still moves vertices of the next one
  std::vector<Made_target> targets = {};
  double seconds = 3;
};

/// A skinned hand, a morphed face, and a body with both.
const std::vector<Made_character>& made_characters();

/// The joints that move a point, with weights that add up to 1: the joint of the nearest capsule, its parent and its
/// children, at most four.
std::vector<std::pair<std::size_t, double>> joints_at(const Made_character& character, const Eigen::Vector3d& point);

/// Writes a binary glTF 2.0 file (.glb).
void write_glb(const Made_character& character, const std::filesystem::path& file);

}  // namespace lodestone
