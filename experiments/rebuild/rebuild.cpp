// SPDX-License-Identifier: GPL-3.0-or-later
// The rule by which the mode exact rebuilds a tree, on motions that make leaves loose and on some that do not.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "lodestone/detector.h"
#include "lodestone/io/motion/deformation.h"
#include "lodestone/io/results/text_table.h"
#include "lodestone/io/shapes/shapes.h"
#include "shared/experiment.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

constexpr std::size_t motion_frames = 240;

/// An object that moves, and a sphere that it meets.
struct Loosening_motion {
  std::string name;
  Surface_mesh mesh;
  Motion motion;
};

/// Tetrahedra that swing through a box, each on a line of its own: pieces that start as neighbours do not stay so.
Loosening_motion drifting_pieces() {
  constexpr std::size_t pieces = 5000;
  std::mt19937_64 random(1);
  const auto uniform = [&random] { return static_cast<double>(random() >> 11U) * 0x1p-53; };
  Surface_mesh mesh;
  std::vector<std::array<double, 3>> speeds;
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    const double x = uniform(), y = uniform(), z = uniform(), size = 0.02;
    const auto a = mesh.add_vertex(Point(x, y, z)), b = mesh.add_vertex(Point(x + size, y, z)),
               c = mesh.add_vertex(Point(x, y + size, z)), d = mesh.add_vertex(Point(x, y, z + size));
    mesh.add_face(a, c, b);
    mesh.add_face(a, b, d);
    mesh.add_face(b, c, d);
    mesh.add_face(c, a, d);
    speeds.push_back({uniform(), uniform(), uniform()});
  }
  const std::vector<Point> rest(mesh.points().begin(), mesh.points().end());
  const auto pose = [rest, speeds](std::size_t frame, std::span<Point> positions) {
    for (std::size_t v = 0; v < rest.size(); ++v) {
      const auto& speed = speeds[v / 4];
      const auto swing = [&](int axis) {
        return 0.5 * std::sin(2 * std::numbers::pi *
                              (speed[axis] + static_cast<double>(frame) * speed[axis] / motion_frames));
      };
      positions[v] = Point(rest[v].x() + swing(0), rest[v].y() + swing(1), rest[v].z() + swing(2));
    }
  };
  return {"20 000 triangles in drifting pieces", mesh, {.frames = motion_frames, .pose = pose}};
}

Loosening_motion deformed(std::string name, Surface_mesh mesh, std::vector<Deformation> deformations) {
  std::vector<Point> rest(mesh.points().begin(), mesh.points().end());
  return {std::move(name), std::move(mesh), deform(std::move(rest), std::move(deformations))};
}

std::vector<Loosening_motion> loosening_motions() {
  std::vector<Loosening_motion> result;
  result.push_back(drifting_pieces());
  result.push_back(deformed("cloth that crumples, 20 000 triangles", cloth(100, 100),
                            {Wobble{.amplitude = 0.3, .waves = 4, .period = 240}}));
  result.push_back(deformed("torus knot that twists by two turns, 20 000 triangles",
                            torus_knot({.segments = 1000, .sides = 10}), {Twist{.degrees = 720, .period = 480}}));
  result.push_back(deformed("sphere that wobbles, 20 480 triangles", icosphere(32), {Wobble{.amplitude = 0.05}}));
  return result;
}

struct Limit_figures {
  double limit;
  std::size_t rebuilds = 0;
  std::vector<double> microseconds = {};
  std::vector<double> loosenesses = {};
  std::size_t different = 0;  ///< frames whose face pairs differ from those of the detector that never rebuilds
};

void play(Loosening_motion& moving, std::span<Limit_figures> rows) {
  Surface_mesh obstacle = icosphere(32);
  for (const auto v : obstacle.vertices()) {
    const Point& p = obstacle.point(v);
    obstacle.point(v) = Point(0.3 * p.x() + 0.5, 0.3 * p.y() + 0.5, 0.3 * p.z() + 0.2);
  }
  std::vector<Detector<>> detectors;
  for (const Limit_figures& row : rows) {
    detectors.emplace_back(Detector_options{.mode = Mode::exact, .exact = {.loosest = row.limit}});
    detectors.back().add(std::as_const(moving.mesh));
    detectors.back().add(std::as_const(obstacle));
  }
  std::vector<Point> positions(moving.mesh.number_of_vertices());
  for (std::size_t frame = 0; frame < motion_frames; ++frame) {
    moving.motion.pose(frame, positions);
    for (const auto v : moving.mesh.vertices()) moving.mesh.point(v) = positions[v];
    std::vector<std::vector<Face_pair>> found(rows.size());
    for (const std::size_t r : order_of_turns(frame, rows.size())) {
      const Frame& result = detectors[r].detect();
      found[r] = result.face_pairs;
      rows[r].rebuilds += result.statistics.repartitions;
      rows[r].loosenesses.push_back(detectors[r].tree(0).looseness());
      if (frame > 0) rows[r].microseconds.push_back(1e6 * result.statistics.seconds.total());
    }
    // The last row never rebuilds.
    for (std::size_t r = 0; r < rows.size(); ++r) rows[r].different += found[r] != found.back() ? 1 : 0;
  }
}

}  // namespace

std::string run_rebuild(const Experiment_context& context) {
  Text_table table({"motion", "limit", "rebuilds", "median frame (us)", "mean frame (us)", "looseness, first", "last",
                    "frames that differ"});
  nlohmann::ordered_json json;
  auto all = loosening_motions();
  for (std::size_t c = 0; c < all.size(); ++c) {
    std::vector<Limit_figures> rows;
    for (const double limit : {1.25, 1.5, 2.0, 4.0, std::numeric_limits<double>::infinity()})
      rows.push_back({.limit = limit});
    play(all[c], rows);
    for (const Limit_figures& row : rows) {
      table.add({all[c].name, std::isinf(row.limit) ? "never" : fmt::format("{}", row.limit),
                 std::to_string(row.rebuilds), fmt::format("{:.1f}", median(row.microseconds)),
                 fmt::format("{:.1f}", mean(row.microseconds)), fmt::format("{:.4f}", row.loosenesses.front()),
                 fmt::format("{:.4f}", row.loosenesses.back()), std::to_string(row.different)});
      json.push_back({{"motion", all[c].name},
                      {"limit", fmt::format("{}", row.limit)},
                      {"rebuilds", row.rebuilds},
                      {"median_microseconds", median(row.microseconds)},
                      {"mean_microseconds", mean(row.microseconds)},
                      {"looseness", row.loosenesses},
                      {"frames_that_differ", row.different}});
    }
    context.progress(c + 1, all.size());
  }
  write_json(context.out, "rebuild", json);
  return fmt::format(
             "All face pairs of a moving object and a sphere of 20 480 triangles that stands still; {} frames, one "
             "core. A tree is rebuilt when its looseness exceeds `limit` times the looseness it was built with.\n\n",
             motion_frames) +
         table.text();
}

}  // namespace lodestone
