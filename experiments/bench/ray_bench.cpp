// SPDX-License-Identifier: GPL-3.0-or-later
// Rays, on trees that were built for collisions, beside libraries that were made for them.
#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "bench/embree_scene.h"
#include "bench/wavy_sphere.h"
#include "bench/worm.h"
#include "lodestone/detector.h"
#include "lodestone/queries/ray_tree.h"
#include "shared/lap_timer.h"
#include "shared/measured_run.h"
#include "shared/random_rays.h"

namespace lodestone {

namespace {

using Cgal_primitive = CGAL::AABB_face_graph_triangle_primitive<Surface_mesh>;
using Cgal_tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Cgal_primitive>>;

std::vector<std::uint32_t> faces_of(std::span<const std::optional<Ray_hit>> hits) {
  std::vector<std::uint32_t> faces;
  for (const auto& hit : hits) faces.push_back(hit ? hit->face : no_face);
  return faces;
}

/// The first face that a ray meets, by CGAL.
std::uint32_t first_face(const Cgal_tree& tree, const Ray& ray) {
  const auto &o = ray.origin, &d = ray.direction;
  const auto hit = tree.first_intersected_primitive(
      Kernel::Ray_3(Point(o.x(), o.y(), o.z()), Kernel::Vector_3(d.x(), d.y(), d.z())));
  return hit ? static_cast<std::uint32_t>(*hit) : no_face;
}

/// The first face that each of some random rays meets. The libraries take turns in each pass. All have been refitted to
/// new positions, but for CGAL, which cannot: it has built its tree for them. Lodestone is asked ray by ray, and by a
/// Ray_tree that is made in each pass, about all rays at once and ray by ray; also about all rays at once by one that
/// was made before the sphere moved, and is refitted. A Detector is asked ray by ray while positions are held, which
/// are read anew in each pass. Embree is asked both ways, without such a tree.
///
/// Reported time: that of Lodestone, ray by ray. Counters: nanoseconds per ray, the least of all passes, and per face
/// for `make_tree_ns` and `refit_tree_ns`; ratios to Lodestone, asked in the same way; rays for which another library
/// names another face.
void first_hit_of_rays(benchmark::State& state) {
  Wavy_sphere sphere(static_cast<std::size_t>(state.range(0)));
#ifdef LODESTONE_EMBREE
  Embree_scene in_float(Embree_kind::triangles, sphere.corners, sphere.coordinates),
      in_double(Embree_kind::exact_numbers, sphere.corners, sphere.coordinates);
#endif
  Ray_tree kept(sphere.tree.view());
  sphere.move(2);
#ifdef LODESTONE_EMBREE
  in_float.refit();
  in_double.refit();
  Answers of_float, of_floats, of_double;
#endif
  Cgal_tree cgal(faces(sphere.mesh).first, faces(sphere.mesh).second, sphere.mesh);
  cgal.build();
  const auto rays = random_rays(20000);
  const std::span<const Ray> few(rays.data(), 2000);
  const Layout_view view = sphere.tree.view();
  Detector<> detector;
  detector.add(sphere.mesh);
  Answers ours, of_tree, of_tree_alone, of_kept, of_held, of_cgal;
  std::vector<double> making, refitting;
  for (auto _ : state) {
    ours.ask(rays, [&](const Ray& ray) {
      const auto hit = first_hit(view, ray);
      return hit ? hit->face : no_face;
    });
    Lap_timer timer;
    const Ray_tree tree(view);
    making.push_back(1e9 * timer.lap() / static_cast<double>(sphere.corners.size()));
    kept.refit(view);
    refitting.push_back(1e9 * timer.lap() / static_cast<double>(sphere.corners.size()));
    of_tree.ask_at_once(rays, [&](std::span<const Ray> all) { return faces_of(first_hits(tree, all)); });
    of_kept.ask_at_once(rays, [&](std::span<const Ray> all) { return faces_of(first_hits(kept, all)); });
    of_tree_alone.ask(rays, [&](const Ray& ray) {
      const auto hit = first_hit(tree, ray);
      return hit ? hit->face : no_face;
    });
    of_held.ask_at_once(rays, [&](std::span<const Ray> all) {
      const auto held = detector.hold_positions();
      std::vector<std::uint32_t> faces;
      for (const Ray& ray : all) {
        const auto hit = detector.first_hit(0, ray);
        faces.push_back(hit ? hit->face : no_face);
      }
      return faces;
    });
#ifdef LODESTONE_EMBREE
    of_floats.ask_at_once(rays, [&](std::span<const Ray> all) { return in_float.first_faces(all); });
    of_float.ask(rays, [&](const Ray& ray) { return in_float.first_face(ray); });
    of_double.ask(rays, [&](const Ray& ray) { return in_double.first_face(ray); });
#endif
    of_cgal.ask(few, [&](const Ray& ray) { return first_face(cgal, ray); });
    state.SetIterationTime(1e-9 * ours.nanoseconds.back() * static_cast<double>(rays.size()));
  }
  state.counters["faces"] = static_cast<double>(sphere.corners.size());
  state.counters["hits_percent"] =
      100 - 100 * static_cast<double>(std::ranges::count(ours.faces, no_face)) / static_cast<double>(rays.size());
  state.counters["lodestone_ns"] = ours.least();
  state.counters["tree_ns"] = of_tree.least();
  state.counters["tree_other"] = static_cast<double>(differences(of_tree.faces, ours.faces));
  state.counters["tree_alone_ns"] = of_tree_alone.least();
  state.counters["tree_alone_other"] = static_cast<double>(differences(of_tree_alone.faces, ours.faces));
  state.counters["make_tree_ns"] = *std::ranges::min_element(making);
  state.counters["refit_tree_ns"] = *std::ranges::min_element(refitting);
  state.counters["kept_ns"] = of_kept.least();
  state.counters["kept_other"] = static_cast<double>(differences(of_kept.faces, ours.faces));
  state.counters["held_ns"] = of_held.least();
  state.counters["held_other"] = static_cast<double>(differences(of_held.faces, ours.faces));
  state.counters["cgal_ns"] = of_cgal.least();
  state.counters["cgal_ratio"] = of_cgal.least() / ours.least();
  state.counters["cgal_other"] = static_cast<double>(differences(of_cgal.faces, ours.faces));
#ifdef LODESTONE_EMBREE
  state.counters["embree_ns"] = of_float.least();
  state.counters["embree_ratio"] = of_float.least() / ours.least();
  state.counters["embree_tree_ratio"] = std::min(of_float.least(), of_floats.least()) / of_tree.least();
  state.counters["embree_tree_alone_ratio"] = of_float.least() / of_tree_alone.least();
  state.counters["embree_all_ns"] = of_floats.least();
  state.counters["embree_other"] = static_cast<double>(differences(of_float.faces, ours.faces));
  state.counters["double_ns"] = of_double.least();
  state.counters["double_ratio"] = of_double.least() / ours.least();
  state.counters["double_tree_ratio"] = of_double.least() / of_tree.least();
  state.counters["double_tree_alone_ratio"] = of_double.least() / of_tree_alone.least();
  state.counters["double_other"] = static_cast<double>(differences(of_double.faces, ours.faces));
#endif
}

BENCHMARK(first_hit_of_rays)
    ->Name("ray/first_hit")
    ->ArgsProduct({{22, 71, 224}})
    ->ArgNames({"frequency"})
    ->UseManualTime()
    ->Iterations(7)
    ->Unit(benchmark::kMillisecond);

/// The first face of rays that are sent from outside to vertices of the sphere, and to the middles of edges: whether a
/// face there is met, and which of several is met first, is mostly too close for floating point. In turns with random
/// rays and with CGAL. Counters: nanoseconds per ray, the least of all passes; ratios to ours; rays for which CGAL
/// names no face, though one is met.
void first_hit_at_vertices(benchmark::State& state) {
  Wavy_sphere sphere(static_cast<std::size_t>(state.range(0)));
  sphere.move(2);
  Cgal_tree cgal(faces(sphere.mesh).first, faces(sphere.mesh).second, sphere.mesh);
  cgal.build();
  const auto random = random_rays(4000);
  std::vector<Ray> rays = random;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto& [a, b, c] = sphere.corners[i * 7919 % sphere.corners.size()];
    const auto at = [&](std::uint32_t v) { return Eigen::Vector3d(sphere.coordinates.data() + 3 * std::size_t{v}); };
    const Eigen::Vector3d target = state.range(1) == 0 ? at(a) : Eigen::Vector3d(0.5 * (at(a) + at(b)));
    rays[i].origin = 2 * target + 0.1 * rays[i].direction.normalized();
    rays[i].direction = target - rays[i].origin;
  }
  const std::span<const Ray> few(rays.data(), 400);
  const Layout_view view = sphere.tree.view();
  const Ray_tree tree(view);
  Answers ours, of_random, of_tree, of_cgal;
  const auto ask = [&](const Ray& ray) {
    const auto hit = first_hit(view, ray);
    return hit ? hit->face : no_face;
  };
  for (auto _ : state) {
    ours.ask(rays, ask);
    of_random.ask(random, ask);
    of_tree.ask_at_once(rays, [&](std::span<const Ray> all) { return faces_of(first_hits(tree, all)); });
    of_cgal.ask(few, [&](const Ray& ray) { return first_face(cgal, ray); });
    state.SetIterationTime(1e-9 * ours.nanoseconds.back() * static_cast<double>(rays.size()));
  }
  std::size_t missed = 0;
  for (std::size_t i = 0; i < few.size(); ++i)
    missed += of_cgal.faces[i] == no_face && ours.faces[i] != no_face ? 1 : 0;
  state.counters["faces"] = static_cast<double>(sphere.corners.size());
  state.counters["lodestone_ns"] = ours.least();
  state.counters["random_ns"] = of_random.least();
  state.counters["tree_ns"] = of_tree.least();
  state.counters["tree_other"] = static_cast<double>(differences(of_tree.faces, ours.faces));
  state.counters["cgal_ns"] = of_cgal.least();
  state.counters["cgal_ratio"] = of_cgal.least() / ours.least();
  state.counters["cgal_missed"] = static_cast<double>(missed);
}

BENCHMARK(first_hit_at_vertices)
    ->Name("ray/at_vertices")
    ->ArgsProduct({{22, 71}, {0, 1}})
    ->ArgNames({"frequency", "edges"})
    ->UseManualTime()
    ->Iterations(7)
    ->Unit(benchmark::kMillisecond);

/// One ray per frame at a skinned worm, which takes a new pose in each: `first_hit` of its Bounded_surface, beside
/// posing all vertices, refitting the tree and then `first_hit`. Some of the time is that of `set_joints`, in neither.
///
/// Reported time: that of the bounded surface. The counters are medians over the frames; `ray_us` is the part of the
/// ray in the time of posing all.
void ray_at_character(benchmark::State& state) {
  Worm worm(static_cast<std::size_t>(state.range(0)));
  std::vector<double> coordinates(3 * std::size_t{worm.points.vertex_count()});
  Tree_surface whole(worm.corners, worm.points.shape().rest());
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<double> bounded, posed, ray_alone, percent;
  std::size_t others = 0, hits = 0;
  int frame = 0;
  for (auto _ : state) {
    ++frame;
    worm.pose(0.1 * frame, {0, 0, 0});
    const Eigen::Vector3d origin(8 * unit(random), 5 * unit(random), 8), at(8 * unit(random), unit(random), 0);
    const Ray ray{origin, at - origin};
    Lap_timer timer;
    const auto found = first_hit(worm.surface, ray);
    bounded.push_back(timer.lap());
    worm.points.pose_all(coordinates);
    Tree_surface* const trees[]{&whole};
    const Coordinates now[]{coordinates};
    refit(trees, now, Workers::alone());
    const double before = timer.lap();
    const auto truth = first_hit(whole.view(), ray);
    ray_alone.push_back(timer.lap());
    posed.push_back(before + ray_alone.back());
    others += found.has_value() != truth.has_value() || (found && found->face != truth->face) ? 1 : 0;
    hits += truth ? 1 : 0;
    percent.push_back(100.0 * static_cast<double>(worm.surface.vertices_posed()) / worm.points.vertex_count());
    state.SetIterationTime(bounded.back());
  }
  state.counters["faces"] = static_cast<double>(worm.corners.size());
  state.counters["bounded_us"] = 1e6 * median(bounded);
  state.counters["posed_us"] = 1e6 * median(posed);
  state.counters["ray_us"] = 1e6 * median(ray_alone);
  state.counters["ratio"] = median(posed) / median(bounded);
  state.counters["posed_percent"] = median(percent);
  state.counters["hits"] = static_cast<double>(hits);
  state.counters["other"] = static_cast<double>(others);
}

BENCHMARK(ray_at_character)
    ->Name("ray/character")
    ->ArgsProduct({{32, 71, 224}})
    ->ArgNames({"frequency"})
    ->UseManualTime()
    ->Iterations(100)
    ->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace lodestone
