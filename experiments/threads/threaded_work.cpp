// SPDX-License-Identifier: GPL-3.0-or-later
#include "threads/threaded_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "lodestone/detector.h"
#include "lodestone/mesh/computed_points.h"
#include "lodestone/mesh/workers.h"
#include "shared/lap_timer.h"
#include "shared/random_rays.h"

namespace lodestone {

namespace {

constexpr std::size_t rounds_of_builds = 5, rounds_of_frames = 15;
constexpr std::size_t vertices_per_task = 2048;

/// Options, and where the second sphere is.
struct Pair_case {
  std::string name;
  Detector_options options = {};
  Moving_pair::Place place = Moving_pair::Place::sunk;
};

Detector_options with_threads(Detector_options options, std::size_t threads) {
  options.threads = threads;
  return options;
}

Detector<> detector_of(const Moving_pair& pair, const Detector_options& options, std::size_t threads) {
  Lbg_options lbg;
  lbg.threads = threads;
  Detector<> detector(with_threads(options, threads), Lbg{.options = lbg});
  for (const auto& mesh : pair.meshes()) detector.add(std::as_const(mesh));
  return detector;
}

/// Seconds of a function.
template <class Function>
double seconds_of(const Function& function) {
  const Lap_timer timer;
  function();
  return timer.seconds();
}

/// Steps of a generator of random numbers, each of which needs the last.
std::uint64_t steps(std::uint64_t state, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) state = state * 6364136223846793005U + 1442695040888963407U;
  return state;
}

/// Tasks of some ten microseconds.
Threaded_work arithmetic(std::string name, std::size_t tasks) {
  return {.name = std::move(name),
          .rounds = rounds_of_frames,
          .pose = [](std::size_t) {},
          .make = [tasks](std::size_t threads) -> std::function<double()> {
            auto workers = std::make_shared<Workers>(threads);
            auto results = std::make_shared<std::vector<std::uint64_t>>(tasks);
            return [workers, results] {
              return seconds_of([&] {
                workers->run(results->size(), [&](std::size_t task, std::size_t) {
                  (*results)[task] = steps((*results)[task] + task, 5000);
                });
              });
            };
          }};
}

/// The sum of the coordinates of some vertices.
double sum_of(std::span<const Point> points) {
  double sum = 0;
  for (const Point& p : points) sum += p.x() + p.y() + p.z();
  return sum;
}

/// Every vertex once, after this thread has moved it, in tasks of some microseconds: hardly any arithmetic.
Threaded_work reading(Moving_pair& pair) {
  return {.name = "reading the vertices alone",
          .rounds = rounds_of_frames,
          .pose = [&pair](std::size_t round) { pair.pose(round, Moving_pair::Place::sunk); },
          .make = [&pair](std::size_t threads) -> std::function<double()> {
            auto workers = std::make_shared<Workers>(threads);
            auto sums = std::make_shared<std::vector<double>>();
            return [&pair, workers, sums] {
              return seconds_of([&] {
                for (const auto& mesh : pair.meshes()) {
                  const std::span<const Point> points(mesh.points().begin(), mesh.points().end());
                  sums->resize(points.size() / vertices_per_task + 1);
                  workers->run(sums->size(), [&](std::size_t task, std::size_t) {
                    const std::size_t first = task * vertices_per_task;
                    (*sums)[task] += sum_of(points.subspan(first, std::min(vertices_per_task, points.size() - first)));
                  });
                }
              });
            };
          }};
}

/// The first answer of a new detector.
Threaded_work build(Moving_pair& pair, const Pair_case& given) {
  return {.name = given.name,
          .rounds = rounds_of_builds,
          .pose = [&pair, place = given.place](std::size_t round) { pair.pose(7 * round, place); },
          .make = [&pair, options = given.options](std::size_t threads) -> std::function<double()> {
            return
                [&pair, options, threads] { return seconds_of([&] { detector_of(pair, options, threads).detect(); }); };
          }};
}

/// A frame of a detector whose objects stand.
Threaded_work frame(Moving_pair& pair, const Pair_case& given) {
  return {.name = given.name,
          .rounds = rounds_of_frames,
          .pose = [&pair, place = given.place](std::size_t round) { pair.pose(round, place); },
          .make = [&pair, options = given.options](std::size_t threads) -> std::function<double()> {
            auto detector = std::make_shared<Detector<>>(detector_of(pair, options, threads));
            detector->detect();
            return [detector] {
              return seconds_of([&] {
                detector->update();
                detector->detect();
              });
            };
          }};
}

/// The distance of two spheres that are apart.
Threaded_work distance(Moving_pair& pair) {
  return {.name = "exact: closest faces",
          .rounds = rounds_of_frames,
          .pose = [&pair](std::size_t round) { pair.pose(round, Moving_pair::Place::apart); },
          .make = [&pair](std::size_t threads) -> std::function<double()> {
            auto detector = std::make_shared<Detector<>>(detector_of(pair, {}, threads));
            detector->detect();
            return [detector] { return seconds_of([&] { detector->closest(0, 1); }); };
          }};
}

/// Many questions about the first sphere at once.
/// @param ask  called with a detector
template <class Ask>
Threaded_work questions(Moving_pair& pair, std::string name, const Ask& ask) {
  return {.name = std::move(name),
          .rounds = rounds_of_frames,
          .pose = [&pair](std::size_t round) { pair.pose(round, Moving_pair::Place::apart); },
          .make = [&pair, ask](std::size_t threads) -> std::function<double()> {
            auto detector = std::make_shared<Detector<>>(detector_of(pair, {}, threads));
            detector->detect();
            return [detector, ask] { return seconds_of([&] { ask(*detector); }); };
          }};
}

/// A frame of two characters whose points know how they move.
Threaded_work certified_frame(Character_scene& scene, std::string name, Contact_query contacts) {
  return {.name = std::move(name),
          .rounds = rounds_of_frames,
          .pose = [&scene](std::size_t round) { scene.pose((2 * round) % scene.frames.size()); },
          .make = [&scene, contacts](std::size_t threads) -> std::function<double()> {
            auto detector = std::make_shared<Detector<>>(
                Detector_options{.mode = Mode::certified, .contacts = contacts, .threads = threads});
            for (const auto& character : scene.characters)
              detector->add(character.mesh, point_map(character.mesh, character.points));
            detector->detect();
            return [detector] { return seconds_of([&] { detector->detect(); }); };
          }};
}

/// A frame of many bodies.
Threaded_work crowd_frame(Scene& crowd, const std::string& name, const Detector_options& options) {
  return {.name = fmt::format("{}, {} bodies", name, crowd.objects.size()),
          .rounds = rounds_of_frames,
          .pose =
              [&crowd](std::size_t round) {
                for (auto& object : crowd.objects) pose(object, round % crowd.frames);
              },
          .make = [&crowd, options](std::size_t threads) -> std::function<double()> {
            auto detector = std::make_shared<Detector<>>(with_threads(options, threads));
            for (const auto& object : crowd.objects) detector->add(std::as_const(object.mesh));
            detector->detect();
            return [detector] { return seconds_of([&] { detector->detect(); }); };
          }};
}

}  // namespace

std::vector<Threaded_work> works_without_memory() {
  return {arithmetic("arithmetic alone, long", 1024), arithmetic("arithmetic alone, short", 32)};
}

std::vector<Threaded_work> works_on(Moving_pair& pair) {
  using enum Moving_pair::Place;
  constexpr auto yes_no = Contact_query::yes_no;
  const std::vector<Ray> rays = random_rays(10000);
  const std::vector<Point> points = random_ray_origins(1000);
  std::vector<Threaded_work> works{
      reading(pair),
      build(pair, {"exact: first answer", {}}),
      build(pair, {"exact: first answer, 12 regions by LBG", {.particles = 12}}),
      frame(pair, {"exact: yes or no, apart", {.contacts = yes_no}, apart}),
      frame(pair, {"exact: all pairs", {}}),
      frame(pair, {"exact: all pairs, points and normals", {.contact_points = true, .contact_normals = true}}),
      frame(pair, {"exact: all pairs and contact patches", {.exact = {.patches = true}}}),
      frame(pair, {"exact: nearer than 0.02", {.exact = {.tolerance = 0.02}}, apart}),
      frame(pair, {"exact: self-collision", {.exact = {.self_collision = true}}, apart}),
      frame(pair, {"exact: containment", {.contacts = yes_no, .exact = {.containment = true}}, inside}),
      frame(pair, {"exact: parting", {.contacts = yes_no, .exact = {.parting = true}}}),
      distance(pair),
      questions(pair, "exact: 10 000 rays", [rays](auto& detector) { detector.first_hits(0, rays); }),
      questions(pair, "exact: 1000 nearest points", [points](auto& detector) { detector.closest_points(0, points); }),
      build(pair, {"particles: first answer", {.mode = Mode::particles, .contacts = yes_no}}),
      frame(pair, {"particles: yes or no", {.mode = Mode::particles, .contacts = yes_no}}),
      frame(pair, {"particles: all pairs", {.mode = Mode::particles}})};
  for (const std::size_t particles : {12, 64, 1024})
    works.push_back(frame(pair, {"published particles, " + std::to_string(particles) + ": all pairs",
                                 {.mode = Mode::particles, .particles = particles, .meetings = 0}}));
  return works;
}

std::vector<Threaded_work> works_on(Character_scene& scene) {
  return {certified_frame(scene, "certified: yes or no", Contact_query::yes_no),
          certified_frame(scene, "certified: all pairs", Contact_query::all)};
}

std::vector<Threaded_work> works_on(Scene& crowd) {
  return {crowd_frame(crowd, "exact: yes or no", {.contacts = Contact_query::yes_no}),
          crowd_frame(crowd, "exact: all pairs", {}),
          crowd_frame(crowd, "exact: nearer than 0.02", {.exact = {.tolerance = 0.02}}),
          crowd_frame(crowd, "exact: self-collision", {.exact = {.self_collision = true}}),
          crowd_frame(crowd, "particles: yes or no", {.mode = Mode::particles, .contacts = Contact_query::yes_no}),
          crowd_frame(crowd, "particles: all pairs", {.mode = Mode::particles})};
}

}  // namespace lodestone
