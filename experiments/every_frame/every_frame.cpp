// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the mode exact with exhaustive checking in every frame of every scene. Nothing is timed.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <utility>

#include "lodestone/detector.h"
#include "lodestone/io/results/text_table.h"
#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/queries/exhaustive.h"
#include "program/scene_hash.h"
#include "shared/experiment.h"
#include "shared/measured_run.h"
#include "shared/race_figures.h"
#include "shared/read_bound.h"
#include "shared/sharded_rows.h"

namespace lodestone {

namespace {

using Exact_detector = Detector<>;

/// What was checked of one scene; the counts are sums over the frames.
struct Checked {
  std::size_t frames = 0;
  std::size_t pairs = 0;         ///< of objects
  std::size_t intersecting = 0;  ///< of these
  std::size_t face_pairs = 0;    ///< true ones
  std::size_t wrong_answers = 0;
  std::size_t wrong_sets = 0;
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

/// Detectors of one scene: all face pairs with one thread and with two, and yes or no.
class Scene_check {
 public:
  explicit Scene_check(Scene& scene) : scene_(scene) {
    for (const auto threads : {1, 2}) add({.mode = Mode::exact, .exact = {.threads = std::size_t(threads)}});
    add({.mode = Mode::exact, .contacts = Contact_query::yes_no});
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
        for (const Frame* answer : answers) compare(*answer, {a, b}, truth, answer != answers.back());
      }
    return checked_;
  }

 private:
  void add(const Detector_options& options) {
    auto& detector = detectors_.emplace_back(options);
    for (const auto& object : scene_.objects) detector.add(std::as_const(object.mesh));
  }

  std::vector<const Frame*> answers_in(std::size_t frame) {
    for (auto& object : scene_.objects) pose(object, frame);
    std::vector<const Frame*> answers;
    for (auto& detector : detectors_) answers.push_back(&detector.detect());
    return answers;
  }

  void compare(const Frame& answer, Object_pair pair, const std::vector<Face_pair>& truth, bool lists) {
    const auto listed =
        std::ranges::find_if(answer.pairs, [&](const auto& p) { return p.a == pair.a && p.b == pair.b; });
    const bool is_listed = listed != answer.pairs.end();
    checked_.wrong_answers += (is_listed && listed->collides) == truth.empty() ? 1 : 0;
    if (!lists) return;
    const auto found = is_listed ? answer.contacts(*listed) : std::span<const Face_pair>();
    checked_.wrong_sets += std::ranges::equal(found, truth) ? 0 : 1;
  }

  Scene& scene_;
  std::vector<Exact_detector> detectors_;
  Checked checked_;
};

using Row = nlohmann::ordered_json;

constexpr std::array<std::pair<const char*, std::size_t Checked::*>, 5> counts{
    {{"object_pairs", &Checked::pairs},
     {"intersecting", &Checked::intersecting},
     {"face_pairs", &Checked::face_pairs},
     {"wrong_answers", &Checked::wrong_answers},
     {"wrong_sets", &Checked::wrong_sets}}};

/// A scene by the name of its file, and its place in the list of all frames.
struct Scene_frames {
  std::string file;
  std::size_t first = 0, count = 0;
};

/// All frames of all scenes, one after the other.
struct Plan {
  std::vector<Scene_frames> scenes;
  Sharded_experiment work{.pieces = 0, .neighbours = true, .inputs = Row::object()};
};

Plan plan_of(const Experiment_context& context) {
  Plan plan;
  const auto files = scene_names(context);
  for_each_scene(context, [&](Scene& scene, const Scene_progress&) {
    const auto& file = files[plan.scenes.size()];
    plan.scenes.push_back({.file = file, .first = plan.work.pieces, .count = scene.frames});
    plan.work.pieces += scene.frames;
    if (context.shard || context.merge_shards) plan.work.inputs[file] = hash_of(scene);
  });
  return plan;
}

/// Plays those of the frames that belong to a scene, and adds a row for each.
void check_scenes(const Experiment_context& context, const Plan& plan, const std::vector<std::size_t>& pieces,
                  const std::function<void(Row)>& add) {
  for (const auto& [file, first, count] : plan.scenes) {
    const auto begin = std::ranges::lower_bound(pieces, first), end = std::ranges::lower_bound(pieces, first + count);
    if (begin == end) continue;
    Scene scene = read_scene(context.scenes / (file + ".json"));
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

  Text_table table({"scene", "frames", "object pairs", "that intersect", "face pairs", "wrong answers", "wrong sets"});
  Row json;
  for (const auto& [scene, checked] : sums_of(plan, made.rows)) {
    table.add({scene, std::to_string(checked.frames), std::to_string(checked.pairs),
               std::to_string(checked.intersecting), std::to_string(checked.face_pairs),
               std::to_string(checked.wrong_answers), std::to_string(checked.wrong_sets)});
    Row figures{{"scene", scene}, {"frames", checked.frames}};
    for (const auto& [name, figure] : counts) figures[name] = checked.*figure;
    json.push_back(std::move(figures));
  }
  write_json(context.out, "every_frame", json);
  return "Every frame puts three questions to the mode exact: all face pairs with one thread, all face pairs with two "
         "threads, and yes or no. The truth is exhaustive checking of all object pairs whose bounding boxes "
         "overlap.\n\n" +
         table.text();
}

}  // namespace lodestone
