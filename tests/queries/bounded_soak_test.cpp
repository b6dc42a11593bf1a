// SPDX-License-Identifier: GPL-3.0-or-later
// Random skinned and morphed surfaces: a Bounded_search gives the answers of mode `exact`, and no bound is broken.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lodestone/bounds/skin_bound.h"
#include "lodestone/find_collisions.h"
#include "lodestone/io/shapes/shapes.h"
#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/queries/bounded_search.h"

namespace lodestone {
namespace {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double number(double low = -1, double high = 1) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  std::size_t below(std::size_t count) { return engine_() % count; }
  bool one_in(std::size_t count) { return below(count) == 0; }
  Eigen::Vector3d vector(double size = 1) { return {number(-size, size), number(-size, size), number(-size, size)}; }

 private:
  std::mt19937_64 engine_;
};

enum class Weighting { any, nearest, smooth, equal };

/// An ellipsoid at rest, some of them flat, some far from the origin.
struct Soft_body {
  Surface_mesh mesh;
  double far;
  std::vector<double> rest;
  std::size_t joint_count;
  Skinned_points points;
  std::vector<Corners> corners;
  Tree_surface tree;
  Skin_bound bound;
  Bounded_surface surface;

  explicit Soft_body(Random& random)
      : mesh(icosphere(1 + random.below(6))),
        far(random.one_in(3) ? std::ldexp(1, static_cast<int>(random.below(40))) : 0),
        rest(rest_of(mesh, far, random)),
        joint_count(1 + random.below(6)),
        points(Morphed_points(rest, targets(random)), influences(random), joint_count),
        corners(Mesh_numbering<Surface_mesh>(mesh).corners()),
        tree(corners, rest, {.leaf_faces = 2 + random.below(60)}),
        bound(points, tree.tree()),
        surface(tree, points, bound) {}
  Soft_body(const Soft_body&) = delete;

  static std::vector<double> rest_of(const Surface_mesh& mesh, double far, Random& random) {
    const double x_size = random.number(0.1, 3), y_size = random.one_in(10) ? 0 : random.number(0, 1.5);
    std::vector<double> rest;
    for (const auto v : mesh.vertices()) {
      const Point& p = mesh.point(v);
      rest.insert(rest.end(), {p.x() * x_size + far, p.y() * y_size, p.z()});
    }
    return rest;
  }
  std::vector<Morph_target> targets(Random& random) const {
    std::vector<Morph_target> targets(random.below(4));
    for (auto& target : targets)
      for (std::uint32_t v = 0; v < rest.size() / 3; ++v) {
        if (random.one_in(2)) continue;
        target.vertices.push_back(v);
        for (int axis = 0; axis < 3; ++axis) target.offsets.push_back(random.number(-0.5, 0.5));
      }
    return targets;
  }
  Joint_influences influences(Random& random) const {
    const auto weighting = static_cast<Weighting>(random.below(4));
    std::vector<Eigen::Vector3d> centres;
    for (std::size_t joint = 0; joint < joint_count; ++joint) centres.push_back(random.vector(1.5));
    Joint_influences influences;
    for (std::size_t v = 0; v < rest.size() / 3; ++v) {
      const Eigen::Vector3d at(rest[3 * v] - far, rest[3 * v + 1], rest[3 * v + 2]);
      for (std::uint32_t joint = 0; joint < joint_count; ++joint) {
        const double distance = (at - centres[joint]).norm();
        const double weight = weighting == Weighting::any       ? random.number(0, 1)
                              : weighting == Weighting::nearest ? (distance < 0.7 ? 1 : 0)
                              : weighting == Weighting::smooth  ? std::exp(-4 * distance * distance)
                                                                : (random.one_in(3) ? 0 : 1);
        influences.joints.push_back(joint);
        influences.weights.push_back(weight);
      }
      influences.joints.push_back(static_cast<std::uint32_t>(random.below(joint_count)));
      influences.weights.push_back(1e-3);  // a joint that is listed twice, and one at least
      influences.begin.push_back(static_cast<std::uint32_t>(influences.joints.size()));
    }
    return influences;
  }

  /// Turns, scales, flattens and shears by each joint, and writes the positions to the mesh.
  void pose(const Eigen::Vector3d& at, Random& random) {
    std::vector<Eigen::Affine3d> motions;
    for (std::size_t joint = 0; joint < joint_count; ++joint) {
      Eigen::Affine3d motion(Eigen::Translation3d(at + random.vector(0.3)) *
                             Eigen::AngleAxisd(random.number(-1.5, 1.5), random.vector().normalized()));
      if (random.one_in(4))
        motion = motion * Eigen::Scaling(random.number(0.2, 1.5), random.number(0.2, 1.5),
                                         random.one_in(5) ? 0.0 : random.number(0.2, 1.5));
      if (random.one_in(6)) motion.linear()(0, 1) += random.number();
      motions.push_back(motion * Eigen::Translation3d(-far, 0, 0));
    }
    points.set_joints(motions);
    std::vector<double> weights(points.shape().target_count());
    for (double& weight : weights) weight = random.one_in(3) ? 0 : random.number();
    points.set_weights(weights);
    for (const auto v : mesh.vertices()) {
      const Eigen::Vector3d moved = points(v);
      mesh.point(v) = Point(moved.x(), moved.y(), moved.z());
    }
  }
};

TEST(Bounded_soak, random_surfaces_have_the_contacts_of_mode_exact) {
  Random random(1);
  std::size_t frames = 0, meetings = 0;
  Bounded_search search;
  for (int bodies = 0; bodies < 300; ++bodies) {
    Soft_body a(random), b(random);
    for (int frame = 0; frame < 8; ++frame, ++frames) {
      a.pose(Eigen::Vector3d::Zero(), random);
      b.pose({random.number(-2.5, 2.5), random.number(), random.number()}, random);
      const auto truth = find_collisions(a.mesh, b.mesh).faces;
      std::vector<Face_pair> found;
      EXPECT_EQ(search.run(a.surface, b.surface, {.query = Contact_query::yes_no}, found).found, !truth.empty());
      search.run(a.surface, b.surface, {}, found);
      EXPECT_EQ(found, truth) << bodies << ", " << frame;
      EXPECT_EQ(a.surface.violations() + b.surface.violations(), 0U);
      meetings += truth.empty() ? 0 : 1;
    }
  }
  EXPECT_GT(meetings, frames / 4);
  EXPECT_LT(meetings, frames - frames / 10);
}

}  // namespace
}  // namespace lodestone
