// SPDX-License-Identifier: GPL-3.0-or-later
// Compares all modes with exhaustive checking in every frame of every scene. Nothing is timed.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <filesystem>
#include <iterator>
#include <utility>

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

/// What was checked of one scene; the counts are sums over the frames.
struct Checked {
  std::size_t frames = 0;
  std::size_t pairs = 0;          ///< of objects
  std::size_t intersecting = 0;   ///< of these
  std::size_t face_pairs = 0;     ///< true ones
  std::size_t wrong_answers = 0;  ///< of the modes that find all
  std::size_t wrong_sets = 0;
  std::size_t invented = 0;  ///< collisions and face pairs of the other modes that are none
};

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
  Checked check(std::size_t frame) {
    checked_ = {.frames = 1};
    const auto answers = answers_in(frame);
    for (Object_id b = 0; b < scene_.objects.size(); ++b)
      for (Object_id a = 0; a < b; ++a) {
        const auto truth = true_pairs(scene_.objects[a].mesh, scene_.objects[b].mesh);
        ++checked_.pairs;
        checked_.intersecting += truth.empty() ? 0 : 1;
        checked_.face_pairs += truth.size();
        for (std::size_t i = 0; i < answers.size(); ++i) compare(*answers[i], {a, b}, truth, options_[i]);
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

  void compare(const Frame& answer, Object_pair pair, const std::vector<Face_pair>& truth,
               const Detector_options& options) {
    const auto listed =
        std::ranges::find_if(answer.pairs, [&](const auto& p) { return p.a == pair.a && p.b == pair.b; });
    const bool collides = listed != answer.pairs.end() && listed->collides;
    const auto found = listed != answer.pairs.end() ? answer.contacts(*listed) : std::span<const Face_pair>();
    if (!finds_all(options.mode)) {
      std::vector<Face_pair> false_pairs;
      std::ranges::set_difference(found, truth, std::back_inserter(false_pairs));
      checked_.invented += false_pairs.size() + (collides && truth.empty() ? 1 : 0);
      return;
    }
    checked_.wrong_answers += collides == truth.empty() ? 1 : 0;
    if (options.contacts == Contact_query::all) checked_.wrong_sets += std::ranges::equal(found, truth) ? 0 : 1;
  }

  Scene& scene_;
  std::deque<Displacement_promise> promises_;
  std::vector<Detector_options> options_;
  std::deque<Detector<>> detectors_;
  Checked checked_;
};

using Row = nlohmann::ordered_json;

constexpr std::array<std::pair<const char*, std::size_t Checked::*>, 6> counts{
    {{"object_pairs", &Checked::pairs},
     {"intersecting", &Checked::intersecting},
     {"face_pairs", &Checked::face_pairs},
     {"wrong_answers", &Checked::wrong_answers},
     {"wrong_sets", &Checked::wrong_sets},
     {"invented", &Checked::invented}}};

/// A scene file, or a folder of real motion, and its place in the list of all frames.
struct Scene_frames {
  std::filesystem::path source;
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
  for (const auto& source : chosen_sources(context, own)) {
    Scene scene = read_source(source);
    plan.scenes.push_back({.source = source, .first = plan.work.pieces, .count = scene.frames});
    plan.work.pieces += scene.frames;
    if (context.shard || context.merge_shards) plan.work.inputs[name_of_source(source)] = hash_of(scene);
  }
  return plan;
}

/// Plays those of the frames that belong to a scene, and adds a row for each.
void check_scenes(const Experiment_context& context, const Plan& plan, const std::vector<std::size_t>& pieces,
                  const std::function<void(Row)>& add) {
  for (const auto& [source, first, count] : plan.scenes) {
    const auto begin = std::ranges::lower_bound(pieces, first), end = std::ranges::lower_bound(pieces, first + count);
    if (begin == end) continue;
    Scene scene = read_source(source);
    Scene_check check(scene);
    if (*begin > first) check.build();
    for (auto piece = begin; piece != end; ++piece) {
      context.progress(static_cast<std::size_t>(piece - pieces.begin()), pieces.size());
      const Checked checked = check.check(*piece - first);
      Row row{{"scene", scene.name}};
      for (const auto& [name, figure] : counts) row[name] = checked.*figure;
      add(std::move(row));
    }
  }
}

/// The sums over the frames of each scene, in the order of the scenes.
std::vector<std::pair<std::string, Checked>> sums_of(const Plan& plan, const std::vector<Row>& rows) {
  std::vector<std::pair<std::string, Checked>> sums;
  for (const auto& scene : plan.scenes) {
    auto& [name, sum] = sums.emplace_back(rows.at(scene.first).at("scene"), Checked{.frames = scene.count});
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
