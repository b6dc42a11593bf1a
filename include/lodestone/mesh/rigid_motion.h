// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "lodestone/mesh/coordinates.h"

namespace lodestone {

/// A rotation and a translation of an object: the positions of its mesh stay as they are, the object is elsewhere.
class Rigid_motion {
 public:
  /// Refuses what is no rotation and translation.
  /// @throws Bad_argument  a coefficient is not finite; the linear part is no rotation: its columns differ by more than
  ///                       10^-6 from unit vectors at right angles, or it mirrors
  explicit Rigid_motion(const Eigen::Isometry3d& motion);

  /// The linear part: its columns are unit vectors at right angles, up to 10^-6.
  const Eigen::Matrix3d& rotation() const { return rotation_; }
  /// What is added after the rotation, in units of the coordinates.
  const Eigen::Vector3d& translation() const { return translation_; }

  /// Where a position of the mesh is placed.
  Eigen::Vector3d operator()(const Eigen::Vector3d& position) const { return rotation_ * position + translation_; }
  /// All positions at once. O(V).
  /// @param placed  memory for the result
  Coordinates operator()(Coordinates coordinates, std::vector<double>& placed) const;

 private:
  Eigen::Matrix3d rotation_;
  Eigen::Vector3d translation_;
};

/// The motion as a Rigid_motion, unless it moves nothing.
/// @return none for the identity, which leaves every position as it is
/// @throws Bad_argument  as Rigid_motion
std::optional<Rigid_motion> make_rigid_motion(const Eigen::Isometry3d& motion);

}  // namespace lodestone
