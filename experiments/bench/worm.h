// SPDX-License-Identifier: GPL-3.0-or-later
// A skinned character for benchmarks.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lodestone/bounds/bounded_surface.h"
#include "lodestone/bounds/skin_bound.h"
#include "lodestone/io/shapes/shapes.h"
#include "lodestone/mesh/skinned_points.h"

namespace lodestone {

inline constexpr std::size_t worm_joints = 20;

/// A worm along x that winds: an ellipsoid, ten times as long as thick, with a chain of joints.
struct Worm {
  Surface_mesh mesh;
  Skinned_points points;
  std::vector<Corners> corners;
  Tree_surface tree;
  Skin_bound bound;
  Bounded_surface surface;

  explicit Worm(std::size_t frequency)
      : mesh(ellipsoid(frequency)),
        points(points_of(mesh)),
        corners(Mesh_numbering<Surface_mesh>(mesh).corners()),
        tree(corners, points.shape().rest()),
        bound(points, tree.tree()),
        surface(tree, points, bound) {}
  Worm(const Worm&) = delete;

  static Surface_mesh ellipsoid(std::size_t frequency) {
    auto mesh = icosphere(frequency);
    for (const auto v : mesh.vertices()) {
      Point& p = mesh.point(v);
      p = Point(10 * p.x(), p.y(), p.z());
    }
    return mesh;
  }
  static Skinned_points points_of(const Surface_mesh& mesh) {
    std::vector<double> rest, weights;
    std::vector<std::uint32_t> followed;
    for (const auto v : mesh.vertices()) {
      const Point& p = mesh.point(v);
      rest.insert(rest.end(), {p.x(), p.y(), p.z()});
      const double along = (p.x() / 20 + 0.5) * (worm_joints - 1);
      const auto joint = std::min(static_cast<std::uint32_t>(along), static_cast<std::uint32_t>(worm_joints - 2));
      followed.insert(followed.end(), {joint, joint + 1});
      weights.insert(weights.end(), {1 - (along - joint), along - joint});
    }
    return {rest, Joint_influences::of(2, followed, weights), worm_joints};
  }
  void pose(double time, const Eigen::Vector3d& at) {
    std::vector<Eigen::Affine3d> motions;
    for (std::size_t joint = 0; joint < worm_joints; ++joint)
      motions.emplace_back(Eigen::Translation3d(at) *
                           Eigen::AngleAxisd(0.03 * (static_cast<double>(joint) - worm_joints / 2.0) * std::sin(time),
                                             Eigen::Vector3d(0, 0.6, 0.8)));
    points.set_joints(motions);
  }
};

}  // namespace lodestone
