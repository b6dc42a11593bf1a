// SPDX-License-Identifier: GPL-3.0-or-later
// Nearest points and sides of points, on trees that were built for collisions, beside libraries that were made for
// them.
#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "bench/embree_scene.h"
#include "bench/wavy_sphere.h"
#include "lodestone/queries/containment.h"
#include "lodestone/queries/point_search.h"
#include "shared/random_rays.h"

namespace lodestone {

namespace {

using Cgal_primitive = CGAL::AABB_face_graph_triangle_primitive<Surface_mesh>;
using Cgal_tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Cgal_primitive>>;

/// The points that a ray begins at; or, each on its way to the centre, as far from there as the surface is, give or
/// take a tenth. With coordinates that float represents.
std::vector<Point> query_points(bool near) {
  auto points = random_ray_origins(4000);
  if (!near) return points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d at =
        Eigen::Vector3d(points[i].x(), points[i].y(), points[i].z()).normalized() * (0.9 + 0.002 * (i % 101));
    const Eigen::Vector3d rounded = at.cast<float>().cast<double>();
    points[i] = Point(rounded.x(), rounded.y(), rounded.z());
  }
  return points;
}

/// Vertices of the sphere, as where a mesh is compared with a copy that has moved in part.
std::vector<Point> some_vertices(const Wavy_sphere& sphere) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < 4000; ++i)
    points.push_back(sphere.mesh.point(CGAL::SM_Vertex_index(sphere.corners[i * 7919 % sphere.corners.size()][0])));
  return points;
}

/// The face nearest to each of some points, beside CGAL's `closest_point_and_primitive` and Embree's `rtcPointQuery`
/// over a hierarchy in float, with distances in double. Where a vertex or an edge is nearest, all of its faces are, and
/// the others may name another of them. `cgal_farther` and `embree_farther` count the points for which theirs is
/// farther by more than rounding.
void closest_points_of_mesh(benchmark::State& state) {
  Wavy_sphere sphere(static_cast<std::size_t>(state.range(0)));
  sphere.move(2);
  Cgal_tree cgal(faces(sphere.mesh).first, faces(sphere.mesh).second, sphere.mesh);
  cgal.build();
  cgal.accelerate_distance_queries();
  const auto points = state.range(1) == 2 ? some_vertices(sphere) : query_points(state.range(1) != 0);
  const Layout_view view = sphere.tree.view();
  Answers ours, of_cgal;
#ifdef LODESTONE_EMBREE
  const Embree_scene embree(Embree_kind::triangles, sphere.corners, sphere.coordinates);
  Answers of_embree;
#endif
  for (auto _ : state) {
    ours.ask(points, [&](const Point& p) { return closest_point(view, p).face; });
#ifdef LODESTONE_EMBREE
    of_embree.ask(points, [&](const Point& p) { return embree.nearest_face(p); });
#endif
    of_cgal.ask(points,
                [&](const Point& p) { return static_cast<std::uint32_t>(cgal.closest_point_and_primitive(p).second); });
    state.SetIterationTime(1e-9 * ours.nanoseconds.back() * static_cast<double>(points.size()));
  }
  const auto farther = [&](const Answers& answers) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& [a, b, c] = sphere.corners[answers.faces[i]];
      const auto at = [&](std::uint32_t v) { return sphere.mesh.point(CGAL::SM_Vertex_index(v)); };
      const double squared = CGAL::squared_distance(Kernel::Triangle_3(at(a), at(b), at(c)), points[i]);
      count += std::sqrt(squared) > closest_point(view, points[i]).distance + 1e-14 ? 1 : 0;
    }
    return static_cast<double>(count);
  };
  state.counters["faces"] = static_cast<double>(sphere.corners.size());
  state.counters["lodestone_ns"] = ours.least();
  state.counters["cgal_ns"] = of_cgal.least();
  state.counters["cgal_ratio"] = of_cgal.least() / ours.least();
  state.counters["cgal_other"] = static_cast<double>(differences(of_cgal.faces, ours.faces));
  state.counters["cgal_farther"] = farther(of_cgal);
#ifdef LODESTONE_EMBREE
  state.counters["embree_ns"] = of_embree.least();
  state.counters["embree_ratio"] = of_embree.least() / ours.least();
  state.counters["embree_other"] = static_cast<double>(differences(of_embree.faces, ours.faces));
  state.counters["embree_farther"] = farther(of_embree);
#endif
}

BENCHMARK(closest_points_of_mesh)
    ->Name("point/closest")
    ->ArgsProduct({{22, 71, 224}, {0, 1, 2}})
    ->ArgNames({"frequency", "random_near_vertices"})
    ->UseManualTime()
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

/// On which side of the sphere some points are, beside CGAL's `Side_of_triangle_mesh`.
void sides_of_points(benchmark::State& state) {
  Wavy_sphere sphere(static_cast<std::size_t>(state.range(0)));
  sphere.move(2);
  const CGAL::Side_of_triangle_mesh<Surface_mesh, Kernel> cgal(sphere.mesh);
  const auto points = query_points(state.range(1) != 0);
  cgal(points.front());  // builds the tree
  const Layout_view view = sphere.tree.view();
  Answers ours, of_cgal;
  for (auto _ : state) {
    ours.ask(points, [&](const Point& p) { return static_cast<std::uint32_t>(point_side(view, p)); });
    of_cgal.ask(points, [&](const Point& p) {
      const auto side = cgal(p);
      return static_cast<std::uint32_t>(side == CGAL::ON_BOUNDED_SIDE     ? Point_side::inside
                                        : side == CGAL::ON_UNBOUNDED_SIDE ? Point_side::outside
                                                                          : Point_side::on_surface);
    });
    state.SetIterationTime(1e-9 * ours.nanoseconds.back() * static_cast<double>(points.size()));
  }
  state.counters["faces"] = static_cast<double>(sphere.corners.size());
  state.counters["inside_percent"] =
      100 * static_cast<double>(std::ranges::count(ours.faces, static_cast<std::uint32_t>(Point_side::inside))) /
      static_cast<double>(points.size());
  state.counters["lodestone_ns"] = ours.least();
  state.counters["cgal_ns"] = of_cgal.least();
  state.counters["cgal_ratio"] = of_cgal.least() / ours.least();
  state.counters["cgal_other"] = static_cast<double>(differences(of_cgal.faces, ours.faces));
}

BENCHMARK(sides_of_points)
    ->Name("point/side")
    ->ArgsProduct({{22, 71, 224}, {0, 1}})
    ->ArgNames({"frequency", "near"})
    ->UseManualTime()
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace lodestone
