// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "lodestone/bounds/node_bound.h"
#include "lodestone/mesh/rigid_motion.h"

namespace lodestone {

/// Around a box that has been moved by an affine map: contains where every point of the box is afterwards, as sums of
/// rounded products give it.
///
/// *Rounding.* With c and h the centre and half the size of the box, R the linear part, t the translation, and
/// m = sum_j |R_ij| (|c_j| + h_j) + |t_i| for axis i, a computed position is rounded at most four times per term, which
/// is less than 4 u m, u = 2^-53; so is each end of the box, once more for the rounding of c and h. The ends are moved
/// outwards by 32 u m, and by 2^-1060 for products that underflow. An axis that overflows is open.
Aabb placed_box(const Eigen::Matrix3d& linear, const Eigen::Vector3d& translation, const Aabb& box);

/// The bound of an object that is placed elsewhere.
class Placed_bound final : public Node_bound {
 public:
  /// @param bound      of the object where its mesh is
  /// @param placement  looked at for each box; must outlive this
  /// @param given      positions in place of those of the mesh, about which the bound says nothing; none: those of the
  ///                   mesh count; must outlive this
  /// @param object     where its mesh is; its layout and positions must outlive this
  Placed_bound(std::unique_ptr<Node_bound> bound, const std::optional<Rigid_motion>& placement,
               const std::optional<Positions>& given, const Bounded_object& object)
      : bound_(std::move(bound)),
        placement_(&placement),
        given_(&given),
        layout_(&object.layout),
        positions_(&object.positions) {}

  /// Number of nodes of the tree.
  std::size_t node_count() const override { return bound_->node_count(); }
  /// The box of the bound, placed.
  Aabb box(std::uint32_t node) const override { return placed(bound_->box(node)); }
  /// The same; positions are added where the object is placed.
  Aabb box(std::uint32_t node, std::vector<Eigen::Vector3d>& read) const override;
  /// Shows the bound where the vertices of a leaf are in the mesh. Moving them back would round. Given positions it
  /// must not see.
  bool note_read(std::uint32_t leaf, const Aabb& fitted, Coordinates coordinates) override;
  bool note_all(std::span<const Aabb> fitted, Coordinates coordinates, bool all) override {
    return *given_ || bound_->note_all(fitted, coordinates, all);
  }
  std::size_t effort() const override { return bound_->effort(); }
  /// Not where vertices lie elsewhere in the mesh.
  bool notes_all() const override { return *given_ || (!*placement_ && bound_->notes_all()); }
  bool watches() const override { return bound_->watches(); }

 private:
  Aabb placed(const Aabb& box) const {
    return *placement_ ? placed_box((*placement_)->rotation(), (*placement_)->translation(), box) : box;
  }

  std::unique_ptr<Node_bound> bound_;
  const std::optional<Rigid_motion>* placement_;
  const std::optional<Positions>* given_;
  const Tree_layout* layout_;
  const Position_source* positions_;
  std::vector<double> in_mesh_;  ///< 3 V where it was needed
};

}  // namespace lodestone
