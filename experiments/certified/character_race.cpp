// SPDX-License-Identifier: GPL-3.0-or-later
#include "certified/character_race.h"

#include <malloc.h>

#include <algorithm>
#include <limits>
#include <set>

#include "lodestone/bounds/skin_bound.h"
#include "lodestone/detector.h"
#include "lodestone/mesh/computed_points.h"
#include "program/measurement.h"
#include "shared/lap_timer.h"
#include "shared/race.h"

namespace lodestone {

namespace {

/// One rival at the start.
struct Runner {
  Rival_figures figures = {};
  bool lists_pairs = false;
  std::unique_ptr<Rival> rival = {};
  double any_spent = 0, all_spent = 0;
};

class Character_race {
 public:
  Character_race(Character_scene& scene, const Character_race_options& options,
                 const std::function<void(double)>& progress)
      : scene_(scene), options_(options), progress_(progress) {
    figures_ = {.scene = scene.name,
                .everything_is_near = scene.everything_is_near,
                .frames = spread(scene.frames.size(), options.most_frames)};
    double influences = 0;
    for (const auto& character : scene.characters) {
      figures_.triangles += character.mesh.number_of_faces();
      figures_.vertices += character.mesh.number_of_vertices();
      for (std::uint32_t v = 0; v < character.points.vertex_count(); ++v)
        influences += static_cast<double>(character.points.influences(v).joints.size());
    }
    figures_.influences = influences / static_cast<double>(figures_.vertices);
  }

  Character_figures run() {
    find_truth();
    time_posing();
    build_runners();
    for (std::size_t pass = 0; pass < options_.passes; ++pass)
      for (std::size_t turn = 0; turn < runners_.size(); ++turn) {
        play(runners_[(pass + turn) % runners_.size()], pass);
        progress_(static_cast<double>(pass * runners_.size() + turn + 1) /
                  static_cast<double>(options_.passes * runners_.size()));
      }
    for (auto& runner : runners_) figures_.rivals.push_back(std::move(runner.figures));
    runners_.clear();
    count_certified();
    return std::move(figures_);
  }

 private:
  std::size_t frame_count() const { return figures_.frames.size(); }

  void find_truth() {
    Detector<> exact;
    for (const auto& character : scene_.characters) exact.add(character.mesh);
    for (const auto frame : figures_.frames) {
      scene_.pose(frame);
      pose_meshes(scene_);
      truth_.push_back(exact.detect().face_pairs);
      figures_.colliding += truth_.back().empty() ? 0 : 1;
      std::array<std::set<std::uint32_t>, 2> touching;
      for (const auto& pair : truth_.back()) touching[0].insert(pair.a), touching[1].insert(pair.b);
      figures_.certified.touching_faces.push_back(static_cast<double>(touching[0].size() + touching[1].size()) /
                                                  static_cast<double>(figures_.triangles));
    }
  }

  void time_posing() {
    std::vector<double> seconds;
    for (const auto frame : figures_.frames) {
      const Lap_timer timer;
      scene_.pose(frame);
      pose_meshes(scene_);
      seconds.push_back(timer.seconds());
    }
    figures_.pose_seconds = median(seconds);
  }

  void build_runners() {
    ::malloc_trim(0);
    auto kinds = rival_kinds();
    for (auto& kind : library_kinds()) kinds.push_back(std::move(kind));
    scene_.pose(0);
    pose_meshes(scene_);
    for (const auto& kind : kinds) {
      if (kind.most_triangles > 0 && figures_.triangles > kind.most_triangles) continue;
      Runner& runner = runners_.emplace_back();
      runner.figures.name = kind.name;
      runner.figures.is_library = kind.is_library;
      runner.lists_pairs = kind.lists_pairs;
      runner.rival = kind.make(scene_);
      runner.figures.any_seconds.assign(frame_count(), std::numeric_limits<double>::infinity());
      if (kind.lists_pairs) runner.figures.all_seconds = runner.figures.any_seconds;
      runner.rival->any();  // the first question builds
      std::vector<Face_pair> found;
      if (kind.lists_pairs) runner.rival->all(found);
    }
  }

  void play(Runner& runner, std::size_t pass) {
    if (pass == 0 || runner.any_spent < options_.enough_seconds) ask_any(runner, pass);
    if (runner.lists_pairs && (pass == 0 || runner.all_spent < options_.enough_seconds)) ask_all(runner, pass);
  }

  void ask_any(Runner& runner, std::size_t pass) {
    for (std::size_t f = 0; f < frame_count(); ++f) {
      const Lap_timer timer;
      scene_.pose(figures_.frames[f]);
      const std::optional<bool> collides = runner.rival->any();
      const double seconds = timer.seconds();
      runner.any_spent += seconds;
      auto& figures = runner.figures;
      figures.any_seconds[f] = std::min(figures.any_seconds[f], seconds);
      if (!collides) figures.gave_up = true;
      if (pass > 0 || !collides) continue;
      figures.missed += !truth_[f].empty() && !*collides ? 1 : 0;
      figures.invented += truth_[f].empty() && *collides ? 1 : 0;
    }
  }

  void ask_all(Runner& runner, std::size_t pass) {
    std::vector<Face_pair> found;
    for (std::size_t f = 0; f < frame_count(); ++f) {
      found.clear();
      const Lap_timer timer;
      scene_.pose(figures_.frames[f]);
      const bool answered = runner.rival->all(found);
      const double seconds = timer.seconds();
      runner.all_spent += seconds;
      auto& figures = runner.figures;
      figures.gave_up |= !answered;
      figures.all_seconds[f] = std::min(figures.all_seconds[f], seconds);
      if (pass > 0) continue;
      std::ranges::sort(found);
      figures.wrong_sets += found != truth_[f] ? 1 : 0;
    }
  }

  /// Once more, untimed, for the counters.
  void count_certified() {
    auto& counts = figures_.certified;
    std::vector<double> tightness;
    Detector<> any({.mode = Mode::certified, .contacts = Contact_query::yes_no}), all({.mode = Mode::certified});
    for (auto* detector : {&any, &all})
      for (const auto& character : scene_.characters)
        detector->add(character.mesh, point_map(character.mesh, character.points));
    scene_.pose(0);
    any.detect(), all.detect();
    for (std::size_t f = 0; f < frame_count(); ++f) {
      scene_.pose(figures_.frames[f]);
      const Frame_statistics of_any = any.detect().statistics, of_all = all.detect().statistics;
      const auto vertices = static_cast<double>(figures_.vertices);
      counts.any_read.push_back(static_cast<double>(of_any.vertices_read) / vertices);
      counts.all_read.push_back(static_cast<double>(of_all.vertices_read) / vertices);
      counts.nodes_bounded.push_back(static_cast<double>(of_any.nodes_bounded));
      counts.violations += of_any.violations + of_all.violations;
      std::size_t near = 0;
      for (Object_id object = 0; object < 2; ++object) near += posed_faces(*all.bounded(object));
      counts.near_faces.push_back(static_cast<double>(near) / static_cast<double>(figures_.triangles));
      if (f % 8 != 4) continue;
      for (Object_id object = 0; object < 2; ++object)
        tightness.push_back(bound_tightness(*all.bounded(object), scene_.characters[object].points));
    }
    if (!tightness.empty()) counts.tightness = median(tightness);
  }

  static std::size_t posed_faces(const Bounded_surface& surface) {
    std::size_t faces = 0;
    for (std::uint32_t leaf = 0; leaf < surface.layout().leaf_count(); ++leaf)
      if (surface.is_posed(leaf)) faces += surface.layout().faces(leaf).size();
    return faces;
  }

  Character_scene& scene_;
  Character_race_options options_;
  const std::function<void(double)>& progress_;
  Character_figures figures_;
  std::vector<std::vector<Face_pair>> truth_;  ///< per frame, sorted
  std::vector<Runner> runners_;
};

Aabb fitted_box(const Tree_layout& layout, const Tree_layout::Node& node, std::span<const double> coordinates) {
  Aabb box{};
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::numeric_limits<double>::infinity();
    box.high[axis] = -box.low[axis];
  }
  for (std::uint32_t leaf = node.leaf; leaf < node.end_leaf; ++leaf)
    for (const auto vertex : layout.vertices(leaf))
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double x = coordinates[3 * std::size_t{vertex} + axis];
        box.low[axis] = std::min(box.low[axis], x);
        box.high[axis] = std::max(box.high[axis], x);
      }
  return box;
}

}  // namespace

Character_figures race(Character_scene& scene, const Character_race_options& options,
                       const std::function<void(double)>& progress) {
  return Character_race(scene, options, progress).run();
}

double bound_tightness(const Bounded_surface& surface, const Skinned_points& points) {
  const Tree_layout& layout = surface.layout();
  const Skin_bound bound(points, layout);
  std::vector<double> coordinates(3 * std::size_t{points.vertex_count()});
  points.pose_all(coordinates);
  double sum = 0;
  std::size_t nodes = 0;
  for (std::uint32_t index = 0; index < layout.node_count(); ++index) {
    const Tree_layout::Node& node = layout.node(index);
    bool is_near = false;
    for (std::uint32_t leaf = node.leaf; leaf < node.end_leaf && !is_near; ++leaf)
      is_near = surface.leaf_state(leaf) != Bounded_surface::Leaf_state::far;
    if (!is_near) continue;
    sum += bound.box(index).extent() / fitted_box(layout, node, coordinates).extent();
    ++nodes;
  }
  return nodes > 0 ? sum / static_cast<double>(nodes) : 1;
}

}  // namespace lodestone
