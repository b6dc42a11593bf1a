// SPDX-License-Identifier: GPL-3.0-or-later
// Compares all modes with exhaustive checking in every frame of every scene. Nothing is timed.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <filesystem>
#include <set>
#include <utility>

#include "every_frame/frame_check.h"
#include "lodestone/bounds/displacement_bound.h"
#include "lodestone/detector.h"
#include "lodestone/io/results/text_table.h"
#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/queries/exhaustive.h"
#include "program/scene_hash.h"
#include "shared/experiment.h"
#include "shared/measured_run.h"
#include "shared/race_figures.h"
#include "shared/read_bound.h"
#include "shared/scene_sources.h"
#include "shared/sharded_rows.h"

namespace lodestone {

namespace {

Box bounds(const Surface_mesh& mesh) {
  const auto& points = mesh.points();
  return read_every_vertex({reinterpret_cast<const double*>(points.data()), 3 * mesh.number_of_vertices()});
}

/// All face pairs of two meshes that intersect; none if the bounding boxes of the meshes are apart.
std::vector<Face_pair> true_pairs(const Surface_mesh& a, const Surface_mesh& b) {
  if (!bounds(a).intersects(bounds(b))) return {};
  return exhaustive_face_pairs(a, b);
}

/// How far the vertices of an object have moved, at most.
double largest_step(const std::vector<Point>& from, const Surface_mesh& mesh) {
  double largest = 0;
  auto before = from.begin();
  for (const auto& point : mesh.points()) largest = std::max(largest, CGAL::squared_distance(*before++, point));
  return std::sqrt(largest) * (1 + 1e-12);  // rounded up
}

/// Detectors of one scene, in all modes. Those of mode `certified` are promised how far vertices move.
class Scene_check {
 public:
  explicit Scene_check(Scene& scene) : scene_(scene), promises_(scene.objects.size()) {
    for (const auto mode : {Mode::exact, Mode::certified}) {
      for (const auto threads : {1, 2}) add({.mode = mode, .threads = std::size_t(threads)});
      add({.mode = mode, .contacts = Contact_query::yes_no});
    }
    add({.mode = Mode::particles});
    add({.mode = Mode::particles, .meetings = 0});
    add({.mode = Mode::senin});
  }

  /// Builds the trees, as every run through the scene does in its first frame.
  void build() { answers_in(0); }

  /// Checks a frame. @return what was checked of it
  Frame_checks check(std::size_t frame) {
    checked_ = {.frames = 1};
    const auto answers = answers_in(frame);
    for (Object_id b = 0; b < scene_.objects.size(); ++b)
      for (Object_id a = 0; a < b; ++a) {
        const auto truth = true_pairs(scene_.objects[a].mesh, scene_.objects[b].mesh);
        ++checked_.pairs;
        checked_.intersecting += truth.empty() ? 0 : 1;
        checked_.face_pairs += truth.size();
        for (std::size_t i = 0; i < answers.size(); ++i)
          compare_with_truth(*answers[i], {a, b}, truth, options_[i], checked_);
      }
    return checked_;
  }

 private:
  void add(const Detector_options& options) {
    options_.push_back(options);
    auto& detector = detectors_.emplace_back(options);
    for (const auto& object : scene_.objects) {
      const Object_id id = detector.add(std::as_const(object.mesh));
      if (options.mode == Mode::certified) detector.promise(id, std::as_const(promises_[id]));
    }
  }

  std::vector<const Frame*> answers_in(std::size_t frame) {
    for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
      auto& object = scene_.objects[i];
      const std::vector<Point> before(object.mesh.points().begin(), object.mesh.points().end());
      pose(object, frame);
      promises_[i].move(largest_step(before, object.mesh));
    }
    std::vector<const Frame*> answers;
    for (auto& detector : detectors_) {
      detector.update();
      answers.push_back(&detector.detect());
    }
    return answers;
  }

  Scene& scene_;
  std::deque<Displacement_promise> promises_;
  std::vector<Detector_options> options_;
  std::deque<Detector<>> detectors_;
  Frame_checks checked_;
};

using Row = nlohmann::ordered_json;

constexpr std::array<std::pair<const char*, std::size_t Frame_checks::*>, 6> counts{
    {{"object_pairs", &Frame_checks::pairs},
     {"intersecting", &Frame_checks::intersecting},
     {"face_pairs", &Frame_checks::face_pairs},
     {"wrong_answers", &Frame_checks::wrong_answers},
     {"wrong_sets", &Frame_checks::wrong_sets},
     {"invented", &Frame_checks::invented}}};

/// A scene file, or a folder of real motion, and its place in the list of all frames.
struct Scene_frames {
  std::filesystem::path source;
  std::string name;  ///< that no other scene has
  std::size_t first = 0, count = 0;
};

/// All frames of all scenes, one after the other.
struct Plan {
  std::vector<Scene_frames> scenes;
  Sharded_experiment work{.pieces = 0, .neighbours = true, .inputs = Row::object()};
};

Plan plan_of(const Experiment_context& context) {
  Plan plan;
  std::vector<std::string> own;
  if (!context.scenes_given) own = scene_names(context);  // which refuses a folder without them
  std::set<std::string> taken;
  for (const auto& source : chosen_sources(context, own)) {
    Scene scene = read_source(source);
    const std::string name = untaken(scene.name, taken);
    plan.scenes.push_back({.source = source, .name = name, .first = plan.work.pieces, .count = scene.frames});
    plan.work.pieces += scene.frames;
    if (context.shard || context.merge_shards) plan.work.inputs[name] = hash_of(scene);
  }
  return plan;
}

/// Plays those of the frames that belong to a scene, and adds a row for each.
void check_scenes(const Experiment_context& context, const Plan& plan, const std::vector<std::size_t>& pieces,
                  const std::function<void(Row)>& add) {
  for (const auto& [source, name, first, count] : plan.scenes) {
    const auto begin = std::ranges::lower_bound(pieces, first), end = std::ranges::lower_bound(pieces, first + count);
    if (begin == end) continue;
    Scene scene = read_source(source);
    Scene_check check(scene);
    if (*begin > first) check.build();
    for (auto piece = begin; piece != end; ++piece) {
      context.progress(static_cast<std::size_t>(piece - pieces.begin()), pieces.size());
      const Frame_checks checked = check.check(*piece - first);
      Row row{{"scene", name}};
      for (const auto& [key, figure] : counts) row[key] = checked.*figure;
      add(std::move(row));
    }
  }
}

/// The sums over the frames of each scene, in the order of the scenes.
std::vector<std::pair<std::string, Frame_checks>> sums_of(const Plan& plan, const std::vector<Row>& rows) {
  std::vector<std::pair<std::string, Frame_checks>> sums;
  for (const auto& scene : plan.scenes) {
    auto& [name, sum] = sums.emplace_back(scene.name, Frame_checks{.frames = scene.count});
    for (std::size_t frame = 0; frame < scene.count; ++frame)
      for (const auto& [key, figure] : counts) sum.*figure += rows.at(scene.first + frame).at(key).get<std::size_t>();
  }
  return sums;
}

}  // namespace

std::string run_every_frame(const Experiment_context& context) {
  const Plan plan = plan_of(context);
  const auto made = rows_of(context, plan.work,
                            [&](const auto& pieces, const auto& add) { check_scenes(context, plan, pieces, add); });
  if (made.shard) return *made.shard;

  Text_table table(
      {"scene", "frames", "object pairs", "that intersect", "face pairs", "wrong answers", "wrong sets", "invented"});
  Row json;
  for (const auto& [scene, checked] : sums_of(plan, made.rows)) {
    table.add({scene, std::to_string(checked.frames), std::to_string(checked.pairs),
               std::to_string(checked.intersecting), std::to_string(checked.face_pairs),
               std::to_string(checked.wrong_answers), std::to_string(checked.wrong_sets),
               std::to_string(checked.invented)});
    Row figures{{"scene", scene}, {"frames", checked.frames}};
    for (const auto& [name, figure] : counts) figures[name] = checked.*figure;
    json.push_back(std::move(figures));
  }
  write_json(context.out, "every_frame", json);
  std::string unplayed;
  if (context.scenes_given && context.only.empty()) unplayed = note_of_unplayed_subfolders(context.scenes);
  if (!unplayed.empty()) unplayed = "\n" + unplayed + "\n";
  return "Every frame puts three questions to the modes exact and certified: all face pairs with one thread, all face "
         "pairs with two threads, and yes or no. Certified is promised how far vertices move at most. What particles "
         "report, with meetings and without, and senin, may be too little, but must be true: else it is invented. The "
         "truth is exhaustive checking of all object pairs whose bounding boxes overlap.\n\n" +
         table.text() + unplayed;
}

}  // namespace lodestone
