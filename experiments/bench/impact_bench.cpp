// SPDX-License-Identifier: GPL-3.0-or-later
// When two surfaces meet first between two frames, beside exhaustive checking and FCL.
#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "lodestone/io/shapes/shapes.h"
#include "lodestone/queries/closest_faces.h"
#include "lodestone/queries/impact_search.h"
#include "lodestone/tree/tree_surface.h"
#include "shared/lap_timer.h"
#include "shared/measured_run.h"

#ifdef LODESTONE_FCL
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/AABB.h>
#include <fcl/math/bv/utility.h>
#include <fcl/narrowphase/detail/traversal/collision/mesh_continuous_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>
#endif

namespace lodestone {

namespace {

/// A mesh in two frames.
struct Two_frames {
  std::vector<Corners> faces;
  std::vector<double> rest, start, end;

  explicit Two_frames(const Surface_mesh& mesh) {
    faces = Mesh_numbering<Surface_mesh>(mesh).corners();
    for (const auto v : mesh.vertices())
      for (int axis = 0; axis < 3; ++axis) rest.push_back(mesh.point(v)[axis]);
    start = end = rest;
  }
  Moving_surface surface() const { return {faces, start, end}; }
};

/// A sphere with waves.
struct Waving_sphere : Two_frames {
  using Two_frames::Two_frames;

  /// Turns it, and moves its centre along the diagonal of all axes; the waves move on from one frame to the next.
  void move(const Eigen::Matrix3d& rotation, double from, double to, double phase) {
    for (std::size_t i = 0; i < rest.size(); i += 3) {
      const Eigen::Map<const Eigen::Vector3d> p(rest.data() + i);
      const auto place = [&](double x, double now, std::vector<double>& frame) {
        const double wave = 1 + 0.02 * std::sin(9 * p.x() + 7 * p.y() + 8 * p.z() + now);
        Eigen::Map<Eigen::Vector3d>(frame.data() + i) =
            wave * (rotation * p) + Eigen::Vector3d::Constant(x / std::sqrt(3.0));
      };
      place(from, phase, start);
      place(to, phase + 1, end);
    }
  }
};

/// A flat sheet that keeps its shape, in a plane that is tilted about the y axis.
struct Flat_sheet : Two_frames {
  Flat_sheet(const Surface_mesh& mesh, double tilt, const Eigen::Vector3d& from, const Eigen::Vector3d& to)
      : Two_frames(mesh) {
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitY()).toRotationMatrix();
    for (std::size_t i = 0; i < rest.size(); i += 3) {
      const Eigen::Map<const Eigen::Vector3d> p(rest.data() + i);
      Eigen::Map<Eigen::Vector3d>(start.data() + i) = rotation * (p + from);
      Eigen::Map<Eigen::Vector3d>(end.data() + i) = rotation * (p + to);
    }
  }
};

/// Times of the searches of one round, in seconds, and what they found.
struct Answer {
  double refit = 0, search = 0;
  std::optional<double> time;
};

class Lodestone_search {
 public:
  Lodestone_search(const Two_frames& a, const Two_frames& b)
      : a_(a), b_(b), tree_a_(a.faces, a.start), tree_b_(b.faces, b.start) {}

  Answer ask() {
    Answer answer;
    Lap_timer timer;
    Tree_surface* const trees[]{&tree_a_, &tree_b_};
    const Coordinates starts[]{a_.start, b_.start};
    refit(trees, starts, Workers::alone());
    const Swept_boxes boxes_a(tree_a_.view(), a_.end), boxes_b(tree_b_.view(), b_.end);
    answer.refit = timer.lap();
    if (const auto impact = first_impact(boxes_a.view(), boxes_b.view())) answer.time = impact->time;
    answer.search = timer.lap();
    return answer;
  }

 private:
  const Two_frames& a_;
  const Two_frames& b_;
  Tree_surface tree_a_, tree_b_;
};

#ifdef LODESTONE_FCL
/// FCL tells the time of every pair of triangles that meet in the step; the earliest is the least of them. It finds
/// roots in double, within a tolerance.
class Fcl_search {
 public:
  Fcl_search(const Two_frames& a, const Two_frames& b) : a_(a), b_(b) {
    build(a_, model_a_);
    build(b_, model_b_);
  }

  Answer ask() {
    Answer answer;
    Lap_timer timer;
    update(a_, model_a_);
    update(b_, model_b_);
    answer.refit = timer.lap();
    fcl::detail::MeshContinuousCollisionTraversalNode<fcl::AABBd> node;
    fcl::CollisionRequestd request;
    request.num_max_contacts = std::size_t{1} << 40U;
    const auto still = fcl::Transform3d::Identity();
    fcl::detail::initialize(node, model_a_, still, model_b_, still, request);
    fcl::detail::collide(&node);
    if (!node.pairs.empty()) answer.time = node.time_of_contact;
    answer.search = timer.lap();
    return answer;
  }

 private:
  using Model = fcl::BVHModel<fcl::AABBd>;

  static std::vector<fcl::Vector3d> points(const std::vector<double>& coordinates) {
    std::vector<fcl::Vector3d> result;
    for (std::size_t i = 0; i < coordinates.size(); i += 3)
      result.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
    return result;
  }
  static void build(const Two_frames& mesh, Model& model) {
    std::vector<fcl::Triangle> triangles;
    for (const auto& [p, q, r] : mesh.faces) triangles.emplace_back(p, q, r);
    model.beginModel();
    model.addSubModel(points(mesh.start), triangles);
    model.endModel();
  }
  /// Two updates: the former positions of the second are those of the first, and its boxes hold both.
  static void update(const Two_frames& mesh, Model& model) {
    for (const auto* frame : {&mesh.start, &mesh.end}) {
      model.beginUpdateModel();
      model.updateSubModel(points(*frame));
      model.endUpdateModel(true, true);
    }
  }

  const Two_frames& a_;
  const Two_frames& b_;
  Model model_a_, model_b_;
};
#endif

double median_of(const std::vector<Answer>& answers, double Answer::*part) {
  std::vector<double> values;
  for (const Answer& answer : answers) values.push_back(answer.*part);
  return 1e3 * median(values);
}

#ifdef LODESTONE_FCL
/// How far apart two surfaces are at a time.
double distance_at(const Two_frames& a, const Two_frames& b, double t) {
  const auto at = [t](const Two_frames& mesh) {
    std::vector<double> coordinates(mesh.start.size());
    for (std::size_t i = 0; i < coordinates.size(); ++i) coordinates[i] = std::lerp(mesh.start[i], mesh.end[i], t);
    return coordinates;
  };
  const auto now_a = at(a), now_b = at(b);
  const Tree_surface tree_a(a.faces, now_a), tree_b(b.faces, now_b);
  return closest_faces(tree_a.view(), tree_b.view()).points.distance;
}
#endif

/// Two spheres of radius 1 that wave and turn, 2.3 apart, and come nearer by a number of thousandths in one step. With
/// 200 they do not meet, though their boxes overlap; with 600 they do, about half-way.
///
/// Reported time: refit and search. The counters are medians. `differ` counts rounds in which FCL says otherwise, or
/// gives a time that differs by more than 10^-6; `gap` is the largest distance of the surfaces at FCL's time. FCL is
/// left out of the largest spheres: 15 rounds in which they meet take it more than 400 s. Exhaustive checking is timed
/// in the first round of the smallest.
void impact(benchmark::State& state) {
  const Surface_mesh mesh = icosphere(static_cast<std::size_t>(state.range(0)));
  const double way = 1e-3 * static_cast<double>(state.range(1));
  Waving_sphere a(mesh), b(mesh);
  a.move(Eigen::Matrix3d::Identity(), 0, 0, 0);
  b.move(Eigen::Matrix3d::Identity(), 2.3, 2.3 - way, 0);
  Lodestone_search search(a, b);
  std::vector<Answer> answers;
#ifdef LODESTONE_FCL
  const bool with_fcl = state.range(0) <= 50;
  Fcl_search fcl_search(a, b);
  std::vector<Answer> fcl_answers;
  int differ = 0;
  double gap = 0;
#endif
  std::mt19937_64 random(1);
  const auto any_rotation = [&random] {
    std::normal_distribution<double> normal;
    const double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
    return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
  };
  int met = 0;
  for (auto _ : state) {
    const auto phase = static_cast<double>(answers.size());
    a.move(any_rotation(), 0, 0, phase);
    b.move(any_rotation(), 2.3, 2.3 - way, phase);
    answers.push_back(search.ask());
    const auto time = answers.back().time;
    met += time ? 1 : 0;
    state.SetIterationTime(answers.back().refit + answers.back().search);
#ifdef LODESTONE_FCL
    if (with_fcl) {
      fcl_answers.push_back(fcl_search.ask());
      const auto other = fcl_answers.back().time;
      if (time.has_value() != other.has_value() || (time && std::abs(*time - *other) > 1e-6)) ++differ;
      if (other) gap = std::max(gap, distance_at(a, b, *other));
    }
#endif
    if (answers.size() > 1 || state.range(0) > 16) continue;
    Lap_timer timer;
    const auto truth = exhaustive_first_impact(a.surface(), b.surface());
    state.counters["exhaustive_ms"] = 1e3 * timer.lap();
    if (truth.has_value() != time.has_value() || (truth && truth->time != *time))
      state.SkipWithError("exhaustive checking finds another impact");
  }
  state.counters["met"] = met;
  state.counters["refit_ms"] = median_of(answers, &Answer::refit);
  state.counters["search_ms"] = median_of(answers, &Answer::search);
#ifdef LODESTONE_FCL
  if (!with_fcl) return;
  state.counters["fcl_refit_ms"] = median_of(fcl_answers, &Answer::refit);
  state.counters["fcl_search_ms"] = median_of(fcl_answers, &Answer::search);
  state.counters["differ"] = differ;
  state.counters["gap"] = gap;
#endif
}

/// A flat sheet lands on another one: all faces meet those below them at nearly the same time, or at exactly the same
/// where the sheets lie along the axes. The arguments are the number of squares along a side, and the tilt in tenths of
/// a radian. The times are medians. `fcl_error` is how far FCL's last time is from 0.31 / 0.51.
void landing(benchmark::State& state) {
  const auto squares = static_cast<std::size_t>(state.range(0));
  const double tilt = 0.1 * static_cast<double>(state.range(1));
  const Surface_mesh mesh = cloth(squares, squares);
  const Flat_sheet a(mesh, tilt, {0.013, 0.017, 0.31}, {0.013, 0.017, -0.2}), b(mesh, tilt, {0, 0, 0}, {0, 0, 0});
  Lodestone_search search(a, b);
  std::vector<Answer> answers;
#ifdef LODESTONE_FCL
  Fcl_search fcl_search(a, b);
  std::vector<Answer> fcl_answers;
#endif
  for (auto _ : state) {
    answers.push_back(search.ask());
    state.SetIterationTime(answers.back().refit + answers.back().search);
    if (!answers.back().time || std::abs(*answers.back().time - 0.31 / 0.51) > 1e-12)
      state.SkipWithError("the sheets meet at another time");
#ifdef LODESTONE_FCL
    fcl_answers.push_back(fcl_search.ask());
#endif
  }
  state.counters["search_ms"] = median_of(answers, &Answer::search);
#ifdef LODESTONE_FCL
  state.counters["fcl_search_ms"] = median_of(fcl_answers, &Answer::search);
  const double fcl_time = fcl_answers.back().time.value_or(std::numeric_limits<double>::infinity());
  state.counters["fcl_error"] = std::abs(fcl_time - 0.31 / 0.51);
#endif
}

BENCHMARK(impact)
    ->ArgsProduct({{16, 50, 158}, {200, 600}})
    ->ArgNames({"frequency", "nearer"})
    ->UseManualTime()
    ->Iterations(15)
    ->Unit(benchmark::kMillisecond);

BENCHMARK(landing)
    ->Name("impact/landing")
    ->ArgsProduct({{30, 100}, {0, 3}})
    ->ArgNames({"squares", "tilt"})
    ->UseManualTime()
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace lodestone
