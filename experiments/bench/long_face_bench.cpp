// SPDX-License-Identifier: GPL-3.0-or-later
// A rod of long faces through a ball of many small ones, beside CGAL's tree of boxes.
#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "lodestone/detector.h"
#include "lodestone/io/shapes/shapes.h"
#include "program/measurement.h"
#include "shared/lap_timer.h"

namespace lodestone {

namespace {

using Ball_primitive = CGAL::AABB_face_graph_triangle_primitive<Surface_mesh>;
using Ball_tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Ball_primitive>>;

/// From the axes to an oblique direction: a rotation of rational numbers.
Point turned(double u, double v, double w) {
  return {0.8 * u - 0.36 * v + 0.48 * w, 0.6 * u + 0.48 * v - 0.64 * w, 0.8 * v + 0.6 * w};
}

/// An open cylinder of radius 1 and length 100, two faces per side.
Surface_mesh rod(std::uint32_t sides, bool oblique) {
  Surface_mesh mesh;
  std::vector<Surface_mesh::Vertex_index> ring;
  for (const double w : {-50.0, 50.0})
    for (std::uint32_t side = 0; side < sides; ++side) {
      const double angle = 2 * M_PI * side / sides, u = std::cos(angle), v = std::sin(angle);
      ring.push_back(mesh.add_vertex(oblique ? turned(u, v, w) : Point(u, v, w)));
    }
  for (std::uint32_t side = 0; side < sides; ++side) {
    const std::uint32_t next = (side + 1) % sides;
    mesh.add_face(ring[side], ring[next], ring[sides + next]);
    mesh.add_face(ring[side], ring[sides + next], ring[sides + side]);
  }
  return mesh;
}

/// Medians of all pairs: of a frame, all positions read; of building CGAL's tree over the ball; and of asking that tree
/// about each face of the rod. Both give the same pairs.
void rod_through_ball(benchmark::State& state) {
  const auto sides = static_cast<std::uint32_t>(state.range(0));
  const bool oblique = state.range(2) != 0;
  const Surface_mesh a = rod(sides, oblique);
  Surface_mesh b = icosphere(static_cast<std::uint32_t>(state.range(1)));
  for (Point& p : b.points()) {
    const double u = 1 + 0.3 * p.x(), v = 0.3 * p.y(), w = 3 + 0.3 * p.z();
    p = oblique ? turned(u, v, w) : Point(u, v, w);
  }
  Detector<> detector;
  detector.add(a), detector.add(b);
  detector.detect();  // builds
  std::vector<double> frames, builds, queries;
  std::vector<Face_pair> pairs, pairs_of_cgal;
  for (auto _ : state) {
    Lap_timer timer;
    const auto& found = detector.detect().face_pairs;
    frames.push_back(timer.lap());
    pairs.assign(found.begin(), found.end());
    timer.lap();
    Ball_tree tree(faces(b).begin(), faces(b).end(), b);
    tree.build();
    builds.push_back(timer.lap());
    pairs_of_cgal.clear();
    std::vector<Surface_mesh::Face_index> met;
    for (const auto face : a.faces()) {
      met.clear();
      const auto first = a.halfedge(face);
      tree.all_intersected_primitives(
          Kernel::Triangle_3(a.point(source(first, a)), a.point(target(first, a)), a.point(target(next(first, a), a))),
          std::back_inserter(met));
      for (const auto of_ball : met) pairs_of_cgal.push_back({face.idx(), of_ball.idx()});
    }
    queries.push_back(timer.lap());
  }
  std::ranges::sort(pairs_of_cgal);
  if (pairs != pairs_of_cgal) state.SkipWithError("other pairs than CGAL's");
  state.counters["triangles"] = static_cast<double>(a.number_of_faces() + b.number_of_faces());
  state.counters["pairs"] = static_cast<double>(pairs.size());
  state.counters["frame_ms"] = 1e3 * median(frames);
  state.counters["cgal_build_ms"] = 1e3 * median(builds);
  state.counters["cgal_query_ms"] = 1e3 * median(queries);
}

BENCHMARK(rod_through_ball)
    ->ArgsProduct({{32, 128}, {30, 60, 120}, {0, 1}})
    ->ArgNames({"sides", "frequency", "oblique"})
    ->Iterations(21)
    ->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace lodestone
