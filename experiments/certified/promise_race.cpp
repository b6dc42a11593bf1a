// SPDX-License-Identifier: GPL-3.0-or-later
#include "certified/promise_race.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

#include "lodestone/bounds/displacement_bound.h"
#include "lodestone/bounds/stretch_bound.h"
#include "lodestone/detector.h"
#include "lodestone/io/motion/computed_motion.h"
#include "lodestone/mesh/computed_points.h"
#include "shared/lap_timer.h"
#include "shared/measured_run.h"
#include "shared/moving_mesh.h"

namespace lodestone {

namespace {

/// Ratios and distances are made longer by their own rounding.
constexpr double rounding = 1 + 1e-12;

double distance(const Point& p, const Point& q) { return std::sqrt(CGAL::squared_distance(p, q)); }

/// What is truly promised of one object, frame by frame.
class Promised_object {
 public:
  explicit Promised_object(Scene_object& object) : object_(&object) {
    last_.assign(object.mesh.points().begin(), object.mesh.points().end());
    for (const auto edge : object.mesh.edges()) lengths_.push_back(length(edge));
    if (object.motion.computed) computed = object.motion.computed(object.file_vertex);
  }

  /// After the mesh has been posed.
  void follow(std::size_t frame) {
    displacement.move(rounding * largest_step());
    stretch.set_stretch(rounding * largest_stretch());
    last_.assign(object_->mesh.points().begin(), object_->mesh.points().end());
    if (computed) computed->set_frame(frame);
  }
  const Surface_mesh& mesh() const { return object_->mesh; }

  Displacement_promise displacement;
  Stretch_promise stretch;
  std::unique_ptr<Computed_motion> computed;  ///< null: the motion is a file

 private:
  double length(Surface_mesh::Edge_index edge) const {
    const auto half = object_->mesh.halfedge(edge);
    return distance(object_->mesh.point(object_->mesh.source(half)), object_->mesh.point(object_->mesh.target(half)));
  }
  double largest_step() const {
    double largest = 0;
    for (const auto v : object_->mesh.vertices())
      largest = std::max(largest, distance(last_[v], object_->mesh.point(v)));
    return largest;
  }
  double largest_stretch() const {
    double largest = 0;
    for (const auto edge : object_->mesh.edges())
      if (const double at_rest = lengths_[edge]; at_rest > 0) largest = std::max(largest, length(edge) / at_rest);
    return largest;
  }

  Scene_object* object_;
  std::vector<Point> last_;
  std::vector<double> lengths_;  ///< of each edge in frame 0
};

using Promised_objects = std::vector<std::unique_ptr<Promised_object>>;

enum class Promise_kind { none, none_computed, displacement, stretch, lipschitz };

/// One row of the table, and the detectors behind it: one for each of the two questions.
class Promise_runner {
 public:
  Promise_runner(Promise_kind kind, const Promised_objects& objects, const Scene& scene)
      : any_({.mode = mode_of(kind), .contacts = Contact_query::yes_no}), all_({.mode = mode_of(kind)}) {
    constexpr const char* names[] = {"none: exact", "none: all posed and exact", "displacement", "stretch",
                                     "Lipschitz"};
    row.promise = names[static_cast<std::size_t>(kind)];
    row.is_computed = is_computed(kind);
    for (auto* detector : {&any_, &all_}) {
      for (const auto& object : objects) add(*detector, kind, *object);
      for (const auto& [a, b] : scene.ignored) detector->ignore(a, b);
    }
  }

  /// @param truth  the answer to the second question; none: this is the truth
  const Frame& play(const Frame* truth, bool is_timed) {
    Lap_timer timer;
    const Frame& any = any_.detect();
    const double any_seconds = timer.lap();
    const Frame& all = all_.detect();
    const double all_seconds = timer.lap();
    row.violations += any.statistics.violations + all.statistics.violations;
    row.wrong_answers += truth != nullptr && any.collides() != truth->collides() ? 1 : 0;
    row.wrong_sets += truth != nullptr && all.face_pairs != truth->face_pairs ? 1 : 0;
    if (is_timed) {
      row.any_read.push_back(static_cast<double>(any.statistics.vertices_read));
      row.all_read.push_back(static_cast<double>(all.statistics.vertices_read));
      row.any_seconds.push_back(any_seconds);
      row.all_seconds.push_back(all_seconds);
    }
    return all;
  }

  Promise_row row;

 private:
  static bool is_computed(Promise_kind kind) {
    return kind == Promise_kind::none_computed || kind == Promise_kind::lipschitz;
  }
  static Mode mode_of(Promise_kind kind) {
    return kind == Promise_kind::none || kind == Promise_kind::none_computed ? Mode::exact : Mode::certified;
  }
  static void add(Detector<>& detector, Promise_kind kind, const Promised_object& object) {
    const Object_id id = is_computed(kind) && object.computed
                             ? detector.add(object.mesh(), point_map(object.mesh(), *object.computed))
                             : detector.add(object.mesh());
    if (kind == Promise_kind::displacement) detector.promise(id, object.displacement);
    if (kind == Promise_kind::stretch) detector.promise(id, object.stretch);
  }

  Detector<> any_, all_;
};

}  // namespace

Promise_figures race_promises(Scene& scene, const std::function<void(double share)>& progress) {
  Promise_figures figures{.scene = scene.name, .frames = scene.frames};
  Promised_objects objects;
  for (auto& object : scene.objects) {
    pose(object, 0);
    objects.push_back(std::make_unique<Promised_object>(object));
    figures.triangles += object.mesh.number_of_faces();
    figures.vertices += object.mesh.number_of_vertices();
  }
  Promise_runner judge(Promise_kind::none, objects, scene);
  std::vector<std::unique_ptr<Promise_runner>> runners;
  for (const auto kind : {Promise_kind::none, Promise_kind::none_computed, Promise_kind::displacement,
                          Promise_kind::stretch, Promise_kind::lipschitz})
    runners.push_back(std::make_unique<Promise_runner>(kind, objects, scene));
  for (std::size_t frame = 0; frame < scene.frames; ++frame) {
    for (std::size_t i = 0; i < objects.size(); ++i) {
      pose(scene.objects[i], frame);
      objects[i]->follow(frame);
    }
    const bool is_timed = frame > 0;  // the first frame builds
    const Frame& truth = judge.play(nullptr, false);
    figures.colliding += truth.collides() ? 1 : 0;
    for (const std::size_t turn : order_of_turns(frame, runners.size())) runners[turn]->play(&truth, is_timed);
    progress(static_cast<double>(frame + 1) / static_cast<double>(scene.frames));
  }
  figures.exact = runners[0]->row;
  figures.posed_and_exact = runners[1]->row;
  for (const auto& runner : std::span(runners).subspan(2)) figures.rows.push_back(runner->row);
  return figures;
}

const Promise_row& exact_beside(const Promise_row& row, const Promise_figures& figures) {
  return row.is_computed ? figures.posed_and_exact : figures.exact;
}

}  // namespace lodestone
