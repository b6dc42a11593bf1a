// SPDX-License-Identifier: GPL-3.0-or-later
// A skinned surface, and bounds around it that hold or do not.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "lodestone/bounds/bounded_surface.h"
#include "lodestone/bounds/skin_bound.h"
#include "lodestone/mesh/skinned_points.h"
#include "support/test_meshes.h"

namespace lodestone {

/// An arm along x that bends at two joints. One morph target makes it thicker.
struct Arm {
  Surface_mesh mesh;
  Skinned_points points;
  std::vector<Corners> corners;
  Tree_surface tree;
  const Tree_layout& layout;
  Skin_bound bound;
  Bounded_surface surface;

  explicit Arm(Surface_mesh shape, bool morphed, std::size_t leaf_faces = 16)
      : mesh(std::move(shape)),
        points(points_of(mesh, morphed)),
        corners(Numbered_mesh(mesh).numbering.corners()),
        tree(corners, points.shape().rest(), {.leaf_faces = leaf_faces}),
        layout(tree.tree()),
        bound(points, layout),
        surface(tree, points, bound) {}
  Arm(const Arm&) = delete;

  static Skinned_points points_of(const Surface_mesh& mesh, bool morphed) {
    std::vector<double> rest, weights;
    std::vector<std::uint32_t> joints;
    Morph_target thicker;
    for (const auto v : mesh.vertices()) {
      const Point& p = mesh.point(v);
      rest.insert(rest.end(), {p.x(), p.y(), p.z()});
      const double along = std::clamp(p.x() + 1, 0.0, 2.0);  // joint 0 up to -1, 1 at 0, 2 from 1 on
      joints.insert(joints.end(), {0, 1, 2});
      weights.insert(weights.end(), {std::max(0.0, 1 - along), 1 - std::abs(along - 1), std::max(0.0, along - 1)});
      thicker.offsets.insert(thicker.offsets.end(), {0, p.y(), p.z()});
    }
    const auto targets = morphed ? std::vector{thicker} : std::vector<Morph_target>();
    return {Morphed_points(rest, targets), Joint_influences::of(3, joints, weights), 3};
  }

  /// Bends the arm, and puts it at a place.
  void pose(double angle, const Eigen::Vector3d& at) {
    std::vector<Eigen::Affine3d> motions;
    for (const double part : {-1.0, 0.0, 1.0})
      motions.emplace_back(Eigen::Translation3d(at) * Eigen::AngleAxisd(part * angle, Eigen::Vector3d(0, 0.6, 0.8)));
    points.set_joints(motions);
    if (points.shape().target_count() > 0) points.set_weights(std::vector{0.1 * angle});
    for (const auto v : mesh.vertices()) {
      const Eigen::Vector3d moved = points(v);
      mesh.point(v) = Point(moved.x(), moved.y(), moved.z());
    }
  }
};

/// A potato along x.
inline Surface_mesh long_potato(int parts, std::uint64_t seed) {
  auto mesh = potato(parts, seed);
  for (const auto v : mesh.vertices())
    mesh.point(v) = Point(2 * mesh.point(v).x(), 0.7 * mesh.point(v).y(), 0.7 * mesh.point(v).z());
  return mesh;
}

/// Promises a box that is too small for some nodes.
struct Shrunk_bound {
  const Skin_bound& truth;
  std::uint32_t from;  ///< nodes from here on shrink

  std::size_t node_count() const { return truth.node_count(); }
  Aabb box(std::uint32_t node) const {
    Aabb box = truth.box(node);
    if (node < from) return box;
    for (int axis = 0; axis < 3; ++axis) {
      const double middle = box.low[axis] / 2 + box.high[axis] / 2;
      box.low[axis] = box.low[axis] / 100 + 0.99 * middle;
      box.high[axis] = box.high[axis] / 100 + 0.99 * middle;
    }
    return box;
  }
};
static_assert(Motion_bound<Shrunk_bound>);

/// Promises nothing.
struct No_bound {
  std::size_t nodes;

  std::size_t node_count() const { return nodes; }
  Aabb box(std::uint32_t) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {.low = {-infinity, -infinity, -infinity, 0}, .high = {infinity, infinity, infinity, 0}};
  }
};
static_assert(Motion_bound<No_bound>);

}  // namespace lodestone
