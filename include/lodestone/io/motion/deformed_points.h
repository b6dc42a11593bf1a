// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lodestone/bounds/node_bound.h"
#include "lodestone/io/motion/deformation.h"
#include "lodestone/mesh/pose_number.h"

namespace lodestone {

namespace detail {
class Deformed_shape;
}

/// Built-in deformations as computed points: the positions that the motion of `deform` gives, vertex by vertex and with
/// the same bits. A model of Computed_points and of Motion_promise.
///
/// Lists are not computed in vectors: sines and cosines take most of the time.
class Deformed_points {
 public:
  /// In frame 0 at first.
  /// @param deformations   applied in order
  /// @throws Bad_argument  as `check`
  Deformed_points(std::vector<Point> rest, std::vector<Deformation> deformations);
  /// Takes a shape with its deformations.
  explicit Deformed_points(detail::Deformed_shape shape);
  ~Deformed_points();
  /// Takes over the points of another, which can then only be assigned to or destroyed.
  Deformed_points(Deformed_points&&) noexcept;
  /// Takes over the points of another, in place of its own.
  Deformed_points& operator=(Deformed_points&&) noexcept;

  /// Changes the pose. O(deformations).
  /// @param frame          finite, >= 0; also between two frames
  /// @throws Bad_argument  the pose stays as it was
  void set_frame(double frame);

  /// How much farther apart than at rest two vertices can be in this pose: before positions are rounded, at most this
  /// many times as far. Infinite where numbers overflow. O(deformations).
  ///
  /// The constants of deformations that follow each other multiply. For a wobble the constant is
  /// 1 + pi |amplitude waves|. A bend has it from the part of the shape that lies farthest towards the outside of the
  /// arc, a twist from the part farthest from the axis. For `Inflate` it is the current factor; for `Travel` and
  /// `Spin` it is 1. After a wobble or a bend, only a ball and a box around the shape are known, so constants may be
  /// larger than needed.
  double lipschitz_constant() const;
  /// How far a position of this pose can be from the exact one, through rounding; in units of the coordinates. With
  /// `lipschitz_constant` what a Lipschitz_promise needs. O(deformations).
  double position_error() const;

  /// Boxes from `lipschitz_constant` and `position_error`. O(V).
  /// @param object  of this must only the layout be; positions and rest are those of the points
  Any_bound bound(const Bounded_object& object) const;

  /// Number of vertices, V.
  std::uint32_t vertex_count() const;
  /// Above 0; grows whenever the pose changes.
  std::uint64_t pose_number() const { return pose_number_; }
  /// Grows when other points are assigned: see Computed_points.
  std::uint64_t shape_number() const { return pose_number_.assignments(); }

  /// One position. O(deformations).
  Eigen::Vector3d operator()(std::uint32_t vertex) const;
  /// The positions of a list.
  /// @param coordinates  3 V; only those of the list are written
  void pose(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const;
  /// All positions.
  /// @param coordinates  3 V
  void pose_all(std::span<double> coordinates) const;

 private:
  struct State;

  std::unique_ptr<State> state_;
  Pose_number pose_number_;
};

}  // namespace lodestone
