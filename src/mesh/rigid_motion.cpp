// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/rigid_motion.h"

#include "lodestone/mesh/errors.h"

namespace lodestone {

Rigid_motion::Rigid_motion(const Eigen::Isometry3d& motion)
    : rotation_(motion.linear()), translation_(motion.translation()) {
  if (!rotation_.allFinite() || !translation_.allFinite())
    throw Bad_argument("a rigid motion has a coefficient that is not finite");
  constexpr double rounding = 1e-6;
  if (!(rotation_.transpose() * rotation_).isIdentity(rounding) || rotation_.determinant() < 0)
    throw Bad_argument(
        "the linear part of a rigid motion is no rotation: its columns must be unit vectors at right "
        "angles, and it must not mirror");
}

Coordinates Rigid_motion::operator()(Coordinates coordinates, std::vector<double>& placed) const {
  placed.resize(coordinates.size());
  for (std::size_t i = 0; i < coordinates.size(); i += 3)
    Eigen::Map<Eigen::Vector3d>(placed.data() + i) = (*this)(Eigen::Map<const Eigen::Vector3d>(coordinates.data() + i));
  return placed;
}

std::optional<Rigid_motion> make_rigid_motion(const Eigen::Isometry3d& motion) {
  const Rigid_motion placement(motion);
  if (motion.matrix() == Eigen::Matrix4d::Identity()) return std::nullopt;
  return placement;
}

}  // namespace lodestone
