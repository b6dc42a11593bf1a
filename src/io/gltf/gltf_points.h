// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/gltf/gltf_scene.h"
#include "lodestone/mesh/skinned_points.h"

namespace lodestone {

/// Vertices of a glTF scene, morphed, then skinned: its parts as one, with the joints and targets of all of them.
class Gltf_points {
 public:
  /// At rest at first.
  /// @param vertices     indices in the scene, in the order of the points
  /// @throws Bad_motion  as `set_time`
  Gltf_points(std::shared_ptr<const Gltf_scene> scene, std::span<const std::uint32_t> vertices);

  /// Changes the pose to a time of an animation of the scene, or to rest without one. O(nodes + curves + targets).
  /// @throws Bad_motion  a weight or the motion of a joint that is not finite, a rotation that has no direction
  void set_time(const Gltf_animation* animation, double time);

  const Skinned_points& points() const { return points_; }

 private:
  std::shared_ptr<const Gltf_scene> scene_;
  std::vector<std::uint32_t> first_joints_;  ///< per part
  Skinned_points points_;
};

/// All vertices of a scene, in order.
std::vector<std::uint32_t> all_vertices(const Gltf_scene& scene);

/// Computes all positions.
/// @param positions    one per point
/// @param name         of the file
/// @throws Bad_motion  one is not finite
void pose_all(const Gltf_points& points, const std::string& name, std::span<Point> positions);

}  // namespace lodestone
