// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies whose positions are computed: by joints, morph targets or formulas.
#include "certified_soak/computed_bodies.h"

#include <cmath>
#include <utility>

#include "certified_soak/rest_shape.h"
#include "lodestone/bounds/own_bound.h"
#include "lodestone/io/motion/deformed_points.h"
#include "lodestone/mesh/skinned_points.h"

namespace lodestone {

namespace {

template <class Points>
class Computed_body : public Random_body {
 public:
  Computed_body(Surface_mesh mesh, Points points)
      : Random_body(std::move(mesh)), points_(std::move(points)), source_(points_) {}

  Object_id add_to(Detector<>& detector) const override { return detector.add(mesh_, point_map(mesh_, points_)); }
  const Position_source& positions() const override { return source_; }
  std::unique_ptr<Node_bound> bound(const Bounded_object& object) const override {
    return std::make_unique<Node_bound_of<decltype(own_bound(points_, object))>>(own_bound(points_, object));
  }

 protected:
  Points points_;

 private:
  Computed_source<Points> source_;
};

/// Computed around the place where it was made: a detector places it elsewhere.
template <class Points>
class Placed_body : public Computed_body<Points> {
 public:
  using Computed_body<Points>::Computed_body;

  std::optional<Eigen::Isometry3d> placement() const override { return placement_; }

 protected:
  /// @param centre  of the body, which comes to lie at `place`
  void put(const Eigen::Vector3d& centre, const Eigen::Vector3d& place, Random& random) {
    const Eigen::Matrix3d turn = random.one_in(3) ? Eigen::Matrix3d::Identity() : random.turn(0.5);
    placement_ = Eigen::Isometry3d(Eigen::Translation3d(place - turn * centre));
    placement_->linear() = turn;
  }

 private:
  std::optional<Eigen::Isometry3d> placement_;
};

/// Waves, or noise: a rough surface, which a frame reads nearly as a whole.
std::vector<Morph_target> random_targets(std::size_t count, const Surface_mesh& mesh, const Eigen::Vector3d& centre,
                                         Random& random) {
  std::vector<Morph_target> targets(count);
  for (auto& target : targets) {
    const bool rough = random.one_in(4), sparse = random.one_in(2);
    const double size = random.number(0, 0.3);
    const Eigen::Vector3d wave = random.vector(3), along = random.direction();
    for (const auto v : mesh.vertices()) {
      const Point& p = mesh.point(v);
      const double height = std::sin(wave.dot(Eigen::Vector3d(p.x(), p.y(), p.z()) - centre));
      if (sparse && (rough ? !random.one_in(8) : height < 0)) continue;
      target.vertices.push_back(v.idx());
      const Eigen::Vector3d offset = rough ? random.vector(size) : Eigen::Vector3d(size * height * along);
      target.offsets.insert(target.offsets.end(), offset.begin(), offset.end());
    }
  }
  return targets;
}

/// Some are 0, as are most in animations.
std::vector<double> random_weights(std::size_t count, Random& random) {
  std::vector<double> weights(count);
  for (double& weight : weights) weight = random.one_in(3) ? 0 : random.number();
  return weights;
}

/// Of a joint for a vertex, before they are normalised.
enum class Weighting {
  any,      ///< drawn
  nearest,  ///< 1 near the joint, 0 elsewhere
  smooth,   ///< less and less with the distance from the joint
  equal,    ///< 1 for most vertices, wherever they are
};

/// Each vertex has a joint; some are listed twice.
Joint_influences random_influences(const Surface_mesh& mesh, const Eigen::Vector3d& centre, std::size_t joints,
                                   Random& random) {
  const auto weighting = random.one_in(2) ? Weighting::smooth : static_cast<Weighting>(random.below(4));
  std::vector<Eigen::Vector3d> joint_centres;
  for (std::size_t joint = 0; joint < joints; ++joint) joint_centres.push_back(random.vector(1.5));
  const auto weight_at = [&](double distance) {
    switch (weighting) {
      case Weighting::any:
        return random.number(0, 1);
      case Weighting::nearest:
        return distance < 0.7 ? 1.0 : 0.0;
      case Weighting::smooth:
        return std::exp(-4 * distance * distance);
      case Weighting::equal:
        break;
    }
    return random.one_in(3) ? 0.0 : 1.0;
  };
  Joint_influences influences;
  for (const Point& p : mesh.points()) {
    const Eigen::Vector3d at = Eigen::Vector3d(p.x(), p.y(), p.z()) - centre;
    for (std::uint32_t joint = 0; joint < joints; ++joint) {
      influences.joints.push_back(joint);
      influences.weights.push_back(weight_at((at - joint_centres[joint]).norm()));
    }
    influences.joints.push_back(static_cast<std::uint32_t>(random.below(joints)));
    influences.weights.push_back(1e-3);  // each vertex needs a joint
    influences.begin.push_back(static_cast<std::uint32_t>(influences.joints.size()));
  }
  return influences;
}

/// Turns, scales, flattens and shears by each joint.
class Skinned_body final : public Computed_body<Skinned_points> {
 public:
  Skinned_body(Surface_mesh mesh, Skinned_points points, Eigen::Vector3d centre)
      : Computed_body(std::move(mesh), std::move(points)), centre_(std::move(centre)) {}

  void move(const Eigen::Vector3d& place, Random& random) override {
    const double spread = random.number(0, 0.2), bend = random.number(0, 1);
    std::vector<Eigen::Affine3d> motions;
    for (std::size_t joint = 0; joint < points_.joint_count(); ++joint) {
      Eigen::Affine3d motion(Eigen::Translation3d(place + random.vector(spread)));
      motion.linear() = random.turn(bend);
      if (random.one_in(6)) {
        const double x = random.number(0.2, 1.5), y = random.number(0.2, 1.5);
        motion = motion * Eigen::Scaling(x, y, random.one_in(5) ? 0.0 : random.number(0.2, 1.5));
      }
      if (random.one_in(8)) motion.linear()(0, 1) += random.number();
      motions.push_back(motion * Eigen::Translation3d(-centre_));
    }
    points_.set_joints(motions);
    points_.set_weights(random_weights(points_.shape().target_count(), random));
  }

 private:
  Eigen::Vector3d centre_;
};

std::unique_ptr<Random_body> skinned_body(const Eigen::Vector3d& centre, std::size_t frequency, std::size_t targets,
                                          Random& random) {
  Surface_mesh mesh = random_ellipsoid(centre, frequency, true, random);
  Morphed_points shape(coordinates_of(mesh), random_targets(targets, mesh, centre, random));
  const std::size_t joints = 1 + random.below(6);
  const Joint_influences influences = random_influences(mesh, centre, joints, random);
  return std::make_unique<Skinned_body>(std::move(mesh), Skinned_points(std::move(shape), influences, joints), centre);
}

class Morphed_body final : public Placed_body<Morphed_points> {
 public:
  Morphed_body(Surface_mesh mesh, Morphed_points points, Eigen::Vector3d centre)
      : Placed_body(std::move(mesh), std::move(points)), centre_(std::move(centre)) {}

  void move(const Eigen::Vector3d& place, Random& random) override {
    points_.set_weights(random_weights(points_.target_count(), random));
    put(centre_, place, random);
  }

 private:
  Eigen::Vector3d centre_;
};

/// Plays its formulas in steps of random length.
class Deformed_body final : public Placed_body<Deformed_points> {
 public:
  Deformed_body(Surface_mesh mesh, Deformed_points points, Eigen::Vector3d centre)
      : Placed_body(std::move(mesh), std::move(points)), centre_(std::move(centre)) {}

  void move(const Eigen::Vector3d& place, Random& random) override {
    frame_ += random.number(0, 3);
    points_.set_frame(frame_);
    put(centre_, place, random);
  }

 private:
  Eigen::Vector3d centre_;
  double frame_ = 0;
};

Deformation random_deformation(Random& random) {
  const Eigen::Vector3d d = random.direction();
  const Kernel::Vector_3 axis(d.x(), d.y(), d.z());
  const double period = random.number(5, 40), size = random.number();
  switch (random.below(4)) {
    case 0:
      return Wobble{.amplitude = 0.1 * size, .waves = random.number(0, 3), .period = period};
    case 1:
      return Bend{.axis = axis, .towards = {-d.y(), d.z(), d.x()}, .degrees = 60 * size, .period = period};
    case 2:
      return Twist{.axis = axis, .degrees = 90 * size, .period = period};
    default:
      return Inflate{.factor = 1 + 0.4 * size, .frames = period};
  }
}

}  // namespace

std::unique_ptr<Random_body> make_skinned(const Eigen::Vector3d& centre, std::size_t frequency, Random& random) {
  return skinned_body(centre, frequency, 0, random);
}

std::unique_ptr<Random_body> make_morphed_and_skinned(const Eigen::Vector3d& centre, std::size_t frequency,
                                                      Random& random) {
  return skinned_body(centre, frequency, 1 + random.below(3), random);
}

std::unique_ptr<Random_body> make_morphed(const Eigen::Vector3d& centre, std::size_t frequency, Random& random) {
  Surface_mesh mesh = random_ellipsoid(centre, frequency, true, random);
  const auto targets = random_targets(1 + random.below(4), mesh, centre, random);
  Morphed_points points(coordinates_of(mesh), targets);
  return std::make_unique<Morphed_body>(std::move(mesh), std::move(points), centre);
}

std::unique_ptr<Random_body> make_deformed(const Eigen::Vector3d& centre, std::size_t frequency, Random& random) {
  Surface_mesh mesh = random_ellipsoid(centre, frequency, true, random);
  std::vector<Deformation> deformations;
  for (std::size_t i = 1 + random.below(3); i > 0; --i) deformations.push_back(random_deformation(random));
  Deformed_points points({mesh.points().begin(), mesh.points().end()}, std::move(deformations));
  return std::make_unique<Deformed_body>(std::move(mesh), std::move(points), centre);
}

}  // namespace lodestone
