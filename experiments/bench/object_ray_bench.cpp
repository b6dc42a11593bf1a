// SPDX-License-Identifier: GPL-3.0-or-later
// Rays among many objects that move.
#include <benchmark/benchmark.h>

#include <cmath>
#include <deque>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "bench/embree_scene.h"
#include "lodestone/detector.h"
#include "lodestone/io/shapes/shapes.h"
#include "program/measurement.h"
#include "shared/lap_timer.h"

namespace lodestone {

namespace {

/// Spheres of 1280 triangles in a cube, all of which move in each frame; and the faces of all.
struct Flock {
  explicit Flock(std::size_t bodies) {
    const double side = 3 * std::cbrt(static_cast<double>(bodies));
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> place(0, side), unit(-1, 1);
    for (std::size_t body = 0; body < bodies; ++body) {
      Surface_mesh& mesh = meshes.emplace_back(icosphere(8));
      const auto first = static_cast<std::uint32_t>(coordinates.size() / 3);
      for (const auto face : mesh.faces()) {
        Corners& corners = faces.emplace_back();
        std::size_t i = 0;
        for (const auto v : vertices_around_face(mesh.halfedge(face), mesh)) corners[i++] = first + v;
      }
      const Kernel::Vector_3 shift(place(random), place(random), place(random));
      for (const auto v : mesh.vertices()) mesh.point(v) += shift;
      coordinates.resize(coordinates.size() + 3 * mesh.number_of_vertices());
    }
    for (int i = 0; i < 10000; ++i)
      rays.push_back({.origin = {place(random), place(random), place(random)},
                      .direction = {unit(random), unit(random), unit(random)}});
    move(0);
  }

  void move(double step) {
    std::size_t at = 0;
    for (Surface_mesh& mesh : meshes)
      for (Point& p : mesh.points()) {
        p = Point(p.x() + step, p.y(), p.z() - step);
        for (int axis = 0; axis < 3; ++axis) coordinates[at++] = p[axis];
      }
  }

  std::deque<Surface_mesh> meshes;
  std::vector<Corners> faces;
  std::vector<double> coordinates;
  std::vector<Ray> rays;
};

/// The first hits of rays by asking one object after the other.
std::vector<std::optional<Object_hit>> hits_by_loop(Detector<>& detector, std::span<const Ray> rays) {
  std::vector<std::optional<Object_hit>> first(rays.size());
  for (Object_id id = 0; id < detector.size(); ++id) {
    const auto hits = detector.first_hits(id, rays);
    for (std::size_t i = 0; i < rays.size(); ++i)
      if (hits[i] && (!first[i] || hits[i]->t < first[i]->hit.t)) first[i] = Object_hit{id, *hits[i]};
  }
  return first;
}

constexpr Object_id no_body = no_face;

Object_id body_of(const std::optional<Object_hit>& hit) { return hit ? hit->object : no_body; }

/// What rays meet first of many bodies that have moved: by one call, and by a loop over the bodies, beside Embree, to
/// which all bodies are one geometry of floats. In all of them positions are read and hierarchies refitted. They take
/// turns.
///
/// Reported time: that of one call. Counters: microseconds of one frame, medians; ratios to one call; rays for which
/// another body comes first.
void first_of_objects(benchmark::State& state) {
  Flock flock(static_cast<std::size_t>(state.range(0)));
  const auto rays = std::span(flock.rays).first(static_cast<std::size_t>(state.range(1)));
  Detector<> one_call, loop;
  for (const auto& mesh : flock.meshes) one_call.add(mesh), loop.add(mesh);
#ifdef LODESTONE_EMBREE
  Embree_scene embree(Embree_kind::triangles, flock.faces, flock.coordinates);
  std::vector<double> of_embree;
  std::size_t embree_other = 0;
#endif
  std::vector<double> of_call, of_loop;
  std::size_t loop_other = 0, hits = 0;
  const auto faces_of_one = static_cast<std::uint32_t>(flock.meshes.front().number_of_faces());
  one_call.detect(), loop.detect();
  for (auto _ : state) {
    flock.move(1e-4);
    Lap_timer timer;
    const auto found = one_call.first_hits(rays);
    of_call.push_back(timer.lap());
    const auto looped = hits_by_loop(loop, rays);
    of_loop.push_back(timer.lap());
#ifdef LODESTONE_EMBREE
    embree.refit();
    const auto faces = embree.first_faces(rays);
    of_embree.push_back(timer.lap());
#endif
    for (std::size_t i = 0; i < rays.size(); ++i) {
      hits += found[i] ? 1 : 0;
      loop_other += body_of(found[i]) != body_of(looped[i]) ? 1 : 0;
#ifdef LODESTONE_EMBREE
      embree_other += body_of(found[i]) != (faces[i] == no_face ? no_body : faces[i] / faces_of_one) ? 1 : 0;
#endif
    }
    state.SetIterationTime(of_call.back());
  }
  state.counters["bodies"] = static_cast<double>(flock.meshes.size());
  state.counters["hits_percent"] =
      100.0 * static_cast<double>(hits) / static_cast<double>(rays.size() * of_call.size());
  state.counters["call_us"] = 1e6 * median(of_call);
  state.counters["loop_ratio"] = median(of_loop) / median(of_call);
  state.counters["loop_other"] = static_cast<double>(loop_other);
#ifdef LODESTONE_EMBREE
  state.counters["embree_ratio"] = median(of_embree) / median(of_call);
  state.counters["embree_other"] = static_cast<double>(embree_other);
#endif
}

BENCHMARK(first_of_objects)
    ->Name("ray/among_objects")
    ->ArgsProduct({{16, 256}, {10, 1000, 10000}})
    ->ArgNames({"bodies", "rays"})
    ->UseManualTime()
    ->Iterations(20)
    ->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace lodestone
