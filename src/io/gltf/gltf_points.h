// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "io/gltf/gltf_scene.h"
#include "lodestone/mesh/skinned_points.h"

namespace lodestone {

/// The vertices of all parts of a glTF scene, morphed, then skinned.
class Gltf_points {
 public:
  /// At rest at first.
  /// @throws Bad_motion  as `set_time`
  explicit Gltf_points(std::shared_ptr<const Gltf_scene> scene);

  /// Changes the pose to a time of an animation of the scene, or to rest without one. O(nodes + curves + targets).
  /// @throws Bad_motion  a weight or the motion of a joint that is not finite, a rotation that has no direction
  void set_time(const Gltf_animation* animation, double time);

  /// Computes all positions.
  /// @param positions    V
  /// @throws Bad_motion  one is not finite
  void pose_all(std::span<Point> positions) const;

 private:
  std::shared_ptr<const Gltf_scene> scene_;
  std::vector<Skinned_points> parts_;
};

}  // namespace lodestone
