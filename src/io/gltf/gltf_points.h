// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "io/gltf/gltf_scene.h"
#include "lodestone/mesh/skinned_points.h"

namespace lodestone {

/// The vertices of all parts of a glTF scene, morphed, then skinned. A model of Computed_points.
class Gltf_points {
 public:
  /// At rest at first.
  /// @throws Bad_motion  as `set_time`
  explicit Gltf_points(std::shared_ptr<const Gltf_scene> scene);

  /// Changes the pose to a time of an animation of the scene, or to rest without one. O(nodes + curves + targets).
  /// @throws Bad_motion  a weight or the motion of a joint that is not finite, a rotation that has no direction
  void set_time(const Gltf_animation* animation, double time);

  std::uint32_t vertex_count() const;
  std::uint64_t pose_number() const { return pose_number_; }

  /// One position.
  Eigen::Vector3d operator()(std::uint32_t vertex) const;
  /// The positions of a list.
  /// @param coordinates  3 V; only those of the list are written
  void pose(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const;
  /// All positions.
  /// @param coordinates  3 V
  void pose_all(std::span<double> coordinates) const;
  /// All positions.
  /// @param positions    V
  /// @throws Bad_motion  one is not finite
  void pose_all(std::span<Point> positions) const;

 private:
  std::shared_ptr<const Gltf_scene> scene_;
  std::vector<Skinned_points> parts_;
  std::vector<std::uint32_t> first_vertex_;  ///< per part
  std::uint64_t pose_number_ = 0;
};

}  // namespace lodestone
