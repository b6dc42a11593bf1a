// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the mode exact with exhaustive checking in every frame of every scene. Nothing is timed.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "lodestone/detector.h"
#include "lodestone/io/results/text_table.h"
#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/queries/exhaustive.h"
#include "shared/experiment.h"
#include "shared/measured_run.h"
#include "shared/race_figures.h"
#include "shared/read_bound.h"

namespace lodestone {

namespace {

using Exact_detector = Detector<>;

/// What was checked of one scene; the counts are sums over the frames.
struct Checked {
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

  void check(std::size_t frame) {
    for (auto& object : scene_.objects) pose(object, frame);
    std::vector<const Frame*> answers;
    for (auto& detector : detectors_) answers.push_back(&detector.detect());
    for (Object_id b = 0; b < scene_.objects.size(); ++b)
      for (Object_id a = 0; a < b; ++a) {
        const auto truth = true_pairs(scene_.objects[a].mesh, scene_.objects[b].mesh);
        ++checked_.pairs;
        checked_.intersecting += truth.empty() ? 0 : 1;
        checked_.face_pairs += truth.size();
        for (const Frame* answer : answers) compare(*answer, {a, b}, truth, answer != answers.back());
      }
  }

  const Checked& checked() const { return checked_; }

 private:
  void add(const Detector_options& options) {
    auto& detector = detectors_.emplace_back(options);
    for (const auto& object : scene_.objects) detector.add(std::as_const(object.mesh));
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

}  // namespace

std::string run_every_frame(const Experiment_context& context) {
  Text_table table({"scene", "frames", "object pairs", "that intersect", "face pairs", "wrong answers", "wrong sets"});
  nlohmann::ordered_json json;
  for_each_scene(context, [&](Scene& scene, const Scene_progress& progress) {
    Scene_check check(scene);
    for (std::size_t frame = 0; frame < scene.frames; ++frame) {
      check.check(frame);
      progress(static_cast<double>(frame + 1) / static_cast<double>(scene.frames));
    }
    const Checked& checked = check.checked();
    table.add({scene.name, std::to_string(scene.frames), std::to_string(checked.pairs),
               std::to_string(checked.intersecting), std::to_string(checked.face_pairs),
               std::to_string(checked.wrong_answers), std::to_string(checked.wrong_sets)});
    json.push_back({{"scene", scene.name},
                    {"frames", scene.frames},
                    {"object_pairs", checked.pairs},
                    {"intersecting", checked.intersecting},
                    {"face_pairs", checked.face_pairs},
                    {"wrong_answers", checked.wrong_answers},
                    {"wrong_sets", checked.wrong_sets}});
  });
  write_json(context.out, "every_frame", json);
  return "Every frame puts three questions to the mode exact: all face pairs with one thread, all face pairs with two "
         "threads, and yes or no. The truth is exhaustive checking of all object pairs whose bounding boxes "
         "overlap.\n\n" +
         table.text();
}

}  // namespace lodestone
