// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "io/files/small_text.h"
#include "lodestone/detection/frame_at_once.h"
#include "lodestone/io/files/atomic_file.h"
#include "lodestone/io/motion/computed_motion.h"
#include "lodestone/io/scenes/given_objects.h"
#include "lodestone/queries/exhaustive.h"
#include "program/commands.h"
#include "program/detect_summary.h"
#include "program/exit_codes.h"
#include "program/frame_log.h"
#include "program/notes.h"
#include "program/page_log.h"
#include "program/paraview_log.h"
#include "program/progress.h"

namespace lodestone {

namespace {

bool is_scene(const std::filesystem::path& input) { return input.extension() == ".json"; }

Scene load(const Detect_command& command) {
  const auto& inputs = command.inputs;
  if (inputs.size() == 1 && is_scene(inputs[0])) return read_scene(inputs[0], {.allow_outside = command.allow_outside});
  for (const auto& input : inputs)
    if (is_scene(input)) throw Bad_argument(input.string() + ": a scene must be the only input");
  Scene scene = scene_of(inputs, {.allow_outside = command.allow_outside});
  if (inputs.size() == 1 && !command.options.exact.self_collision)
    throw Bad_argument(inputs[0].string() +
                       ": one mesh alone has nothing to collide with; give a scene or two meshes, or --self for "
                       "collisions with itself");
  return scene;
}

/// The page also shows the candidates, which are listed outside the timed stages.
Detector_options detector_options(const Detect_command& command) {
  Detector_options options = command.options;
  options.list_candidates = !command.html.empty();
  return options;
}

/// Whether the first frame may be made without a detector. Files of results tell what the detector has built.
bool asks_once(const Detect_command& command, const Scene& scene) {
  const bool prints_only = command.out.empty() && command.html.empty() && command.paraview.empty() && !command.json;
  return scene.frames == 1 && scene.objects.size() == 2 && !scene.ignores({0, 1}) && prints_only &&
         !command.chooses_strategy && !command.closest && !command.options.exact.self_collision &&
         can_answer_at_once(command.options);
}

/// A run through a scene: the detector, the truth beside it, and the results so far.
class Run {
 public:
  explicit Run(const Detect_command& command) : command_(command), scene_(load(command)) {
    asks_once_ = asks_once(command, scene_);
    if (command.options.mode == Mode::certified) compute_motions();
    if (!asks_once_) make_detector();
    summary_.measurement.setting.options = command.options;
    if (!command.html.empty()) page_.emplace(command, scene_, *detector_);
    if (!command.paraview.empty()) paraview_.emplace(command.paraview, scene_.frames);
  }

  std::size_t frames() const { return scene_.frames; }
  std::string play(std::size_t frame);
  nlohmann::ordered_json summary() const { return summary_json(subject(), summary_); }
  void print() const { print_summary(subject(), summary_); }
  std::string answer() const { return one_line_answer(subject(), summary_); }
  bool finds_any() const { return summary_.finds_any(); }
  const Scene& scene() const { return scene_; }
  /// Tells at which objects particles walk across seams.
  void note_seams() const {
    if (finds_all(command_.options.mode)) return;
    for (Object_id id = 0; id < scene_.objects.size(); ++id)
      note_joined_vertices(scene_.objects[id].name, detector_->object(id).joined_vertices(),
                           scene_.objects[id].mesh.number_of_vertices());
  }
  /// Null if no page was requested.
  Page_log* page() { return page_ ? &*page_ : nullptr; }
  Paraview_log* paraview() { return paraview_ ? &*paraview_ : nullptr; }
  /// Whether a false contact was reported, or mode exact missed one.
  bool contradicts_truth() const { return contradicted_ || (missed_ && finds_all(command_.options.mode)); }

 private:
  Run_subject subject() const { return {command_, scene_, detector_ ? &*detector_ : nullptr}; }
  void compute_motions();
  void make_detector();
  void pose_all(std::size_t frame);
  const Frame& detect();
  template <class Visit>
  void for_each_pair(const Visit& visit) const;
  std::optional<std::vector<Pair_truth>> find_truth() const;
  std::optional<std::vector<Pair_closest>> find_closest();
  void compare(const Frame& result, const std::vector<Pair_truth>& truth);
  std::optional<bool> any_truth(const std::optional<std::vector<Pair_truth>>& truth) const;

  const Detect_command& command_;
  Scene scene_;
  std::vector<std::unique_ptr<Computed_motion>> computed_;  ///< per object in mode certified; null: read from files
  bool asks_once_ = false;
  std::optional<Scene_detector> detector_;  ///< none if the only frame has been made without one
  std::optional<Frame> only_frame_;         ///< the one that has been made so
  Run_summary summary_;
  std::optional<Page_log> page_;
  std::optional<Paraview_log> paraview_;
  bool contradicted_ = false, missed_ = false;
};

/// What need not be posed as a whole is posed by the detector, where it looks.
void Run::compute_motions() {
  for (const auto& object : scene_.objects)
    computed_.push_back(object.motion.computed ? object.motion.computed(object.file_vertex) : nullptr);
}

void Run::make_detector() {
  detector_.emplace(detector_options(command_), make_strategy(command_.partition.name, command_.partition.settings));
  for (std::size_t number = 0; number < scene_.objects.size(); ++number) {
    auto& object = scene_.objects[number];
    Object_options options{.particles = command_.options.particles > 0 ? 0 : object.particles,
                           .groups = object.collision.groups,
                           .meets = object.collision.meets};
    if (const auto& side = object.scattered_side) options.scattered_side = coordinates(*side);
    options.file_vertex = object.file_vertex;
    options.name = object.name;
    if (number < computed_.size() && computed_[number])
      detector_->add(object.mesh, point_map(object.mesh, *computed_[number]), options);
    else
      detector_->add(object.mesh, options);
  }
  for (const auto& pair : scene_.ignored) detector_->ignore(pair.a, pair.b);
}

const Frame& Run::detect() {
  if (asks_once_) {
    only_frame_ = frame_at_once(scene_.objects[0].mesh, scene_.objects[1].mesh, command_.options);
    if (only_frame_) return *only_frame_;
    make_detector();
  }
  detector_->update();
  return detector_->detect();
}

/// Moves all objects; only those meshes whose positions somebody reads.
void Run::pose_all(std::size_t frame) {
  const bool shown = command_.truth || !command_.html.empty() || !command_.paraview.empty();
  for (std::size_t number = 0; number < scene_.objects.size(); ++number) {
    const bool computed = number < computed_.size() && computed_[number];
    if (computed) computed_[number]->set_frame(frame);
    if (!computed || shown) pose(scene_.objects[number], frame);
  }
}

std::string Run::play(std::size_t frame) {
  pose_all(frame);
  const Frame& result = detect();
  // The first frame builds, and finds all positions outside the caches.
  summary_.add(frame, result, frame > 0 || scene_.frames == 1);
  if (paraview_) paraview_->add(frame, scene_, result);
  const auto truth = find_truth();
  if (truth) compare(result, *truth);
  const auto closest = find_closest();
  if (closest) summary_.add(frame, *closest);
  std::string line = frame_line(frame, scene_.objects, result, command_.options, truth, closest);
  if (page_) page_->add(frame, result, line, any_truth(truth));
  return line;
}

/// Whether any surfaces intersect, if exhaustive checking decides it: it does not check for self-collisions.
std::optional<bool> Run::any_truth(const std::optional<std::vector<Pair_truth>>& truth) const {
  if (!truth || command_.options.exact.self_collision) return std::nullopt;
  return std::ranges::any_of(*truth, [](const auto& pair) { return !pair.faces.empty(); });
}

/// Calls `visit` with each pair of two objects that may collide.
template <class Visit>
void Run::for_each_pair(const Visit& visit) const {
  for (Object_id a = 0; a < scene_.objects.size(); ++a)
    for (Object_id b = a + 1; b < scene_.objects.size(); ++b)
      if (!scene_.ignores({a, b})) visit(a, b);
}

std::optional<std::vector<Pair_truth>> Run::find_truth() const {
  if (!command_.truth) return std::nullopt;
  std::vector<Pair_truth> truth;
  for_each_pair([&](Object_id a, Object_id b) {
    truth.push_back({a, b, exhaustive_face_pairs(scene_.objects[a].mesh, scene_.objects[b].mesh)});
  });
  return truth;
}

std::optional<std::vector<Pair_closest>> Run::find_closest() {
  if (!command_.closest) return std::nullopt;
  std::vector<Pair_closest> closest;
  for_each_pair([&](Object_id a, Object_id b) { closest.push_back({a, b, detector_->closest(a, b)}); });
  return closest;
}

void Run::compare(const Frame& result, const std::vector<Pair_truth>& truth) {
  for (const auto& real : truth) {
    const auto found =
        std::ranges::find_if(result.pairs, [&](const auto& p) { return p.a == real.a && p.b == real.b; });
    const bool listed = found != result.pairs.end();
    const bool seen = listed && found->collides;
    summary_.pairs[{real.a, real.b}].score.add({real.a, real.b}, !real.faces.empty(), seen);
    missed_ |= !real.faces.empty() && !seen;
    if (!listed) continue;
    contradicted_ |= found->collides && real.faces.empty();
    const auto contacts = result.contacts(*found);
    // With a tolerance the contacts include faces that are only near.
    contradicted_ |= command_.options.exact.tolerance == 0 && !std::ranges::includes(real.faces, contacts);
    if (command_.options.contacts == Contact_query::all && !found->capped)
      missed_ |= !std::ranges::includes(contacts, real.faces);
  }
}

/// Writes all files to disk before the first appears.
void write_results(Run& scene_run, std::optional<Atomic_file>& frames, const Detect_command& command) {
  std::optional<Atomic_file> summary;
  if (frames) {
    summary.emplace(command.out / "summary.json");
    summary->write(json_text(scene_run.summary(), 2));
    frames->finish();
    summary->finish();
  }
  if (scene_run.page() != nullptr) scene_run.page()->finish();
  if (scene_run.paraview() != nullptr) scene_run.paraview()->finish();
  if (frames) frames->commit();
  if (summary) summary->commit();
  if (scene_run.page() != nullptr) scene_run.page()->commit();
  if (scene_run.paraview() != nullptr) scene_run.paraview()->commit();
}

/// What the user reads on the terminal.
void print_results(Run& scene_run, const Detect_command& command) {
  if (command.json) return fmt::print("{}", json_text(scene_run.summary(), 2));
  if (command.quiet) return fmt::print("{}", scene_run.answer());
  for (const auto& object : scene_run.scene().objects) note_cut_faces(object.name, object.file_face);
  scene_run.note_seams();
  scene_run.print();
  if (!command.out.empty()) fmt::print("results: {}\n", printable(command.out.string()));
  if (scene_run.page() != nullptr) fmt::print("{}", scene_run.page()->summary());
}

int exit_code_of(const Run& scene_run, const Detect_command& command) {
  if (scene_run.contradicts_truth()) return exit_code::contradicts_truth;
  return command.exit_code && scene_run.finds_any() ? exit_code::collides : exit_code::success;
}

}  // namespace

int run(const Detect_command& command) {
  Run scene_run(command);
  std::optional<Atomic_file> frames;
  if (!command.out.empty()) frames.emplace(command.out / "frames.jsonl");
  {
    Progress_bar progress("detect", command.quiet || command.json);
    for (std::size_t frame = 0; frame < scene_run.frames(); ++frame) {
      const auto line = scene_run.play(frame);
      if (frames) frames->write(line);
      progress(frame + 1, scene_run.frames());
    }
  }
  write_results(scene_run, frames, command);
  print_results(scene_run, command);
  return exit_code_of(scene_run, command);
}

}  // namespace lodestone
