// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/detect_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "lodestone/detection/frame_at_once.h"
#include "lodestone/io/scenes/given_objects.h"
#include "lodestone/io/scenes/object_options.h"
#include "lodestone/io/scenes/separated_objects.h"
#include "lodestone/queries/exhaustive.h"
#include "program/source_revision.h"

namespace lodestone {

namespace {

/// @throws Bad_argument  one mesh alone, which is not to be compared with itself
void check_not_alone(const Scene& scene, const Detect_command& command) {
  if (scene.objects.size() > 1 || command.options.exact.self_collision) return;
  throw Bad_argument(fmt::format(
      "{}: one {} alone has nothing to collide with; give a scene or two meshes, or --self for collisions with "
      "itself{}",
      command.inputs[0].string(), command.components ? "connected component" : "mesh", hint_at_components(command)));
}

Scene load(const Detect_command& command) {
  Scene scene = read_inputs(command.inputs, command.reading);
  if (command.parts) separate(scene, Separate::parts, command.reading.max_objects);
  if (command.components) separate(scene, Separate::components, command.reading.max_objects);
  if (!is_scene_file(command.inputs)) check_not_alone(scene, command);
  return scene;
}

/// The page also shows the candidates, which are listed outside the timed stages.
Detector_options detector_options(const Detect_command& command) {
  Detector_options options = command.options;
  options.list_candidates = !command.html.empty();
  if (command.independent_frames) options.exact.loosest = std::numeric_limits<double>::infinity();
  return options;
}

/// Whether the first frame may be made without a detector. Files of results tell what the detector has built.
bool asks_once(const Detect_command& command, const Scene& scene) {
  const bool prints_only = command.out.empty() && command.html.empty() && command.paraview.empty() && !command.json;
  return scene.frames == 1 && scene.objects.size() == 2 && !scene.ignores({0, 1}) && prints_only &&
         !command.chooses_strategy && !command.closest && !command.options.exact.self_collision &&
         can_answer_at_once(command.options);
}

/// A surface in one frame, for exhaustive checking.
struct Surface_now {
  explicit Surface_now(const Surface_mesh& mesh) : numbering(mesh), positions(positions_of(mesh)) {
    for (const auto& position : positions.rowwise()) box.extend(position.transpose());
  }

  Mesh_numbering<Surface_mesh> numbering;
  Positions positions;
  Box box = {};
};

/// With a single object, checked against itself, these options would be ignored.
/// @throws Bad_argument  names the option
void refuse_questions_about_pairs(const Scene& scene, const Detect_command& command) {
  const Exact_options& exact = command.options.exact;
  if (scene.objects.size() != 1 || !exact.self_collision) return;
  const auto refuse = [](bool is_given, const char* option, const char* hint = "") {
    if (is_given) throw Bad_argument(fmt::format("{} is about two objects, and there is one only{}", option, hint));
  };
  refuse(exact.tolerance > 0, "--within", ": for faces of one object take --self-within");
  refuse(exact.containment, "--containment");
  refuse(exact.parting, "--parting");
  refuse(command.closest, "--closest");
  refuse(command.truth, "--truth");
}

}  // namespace

Detect_run::Detect_run(const Detect_command& command)
    : command_(command), scene_(load(command)), revision_(source_revision()) {
  summary_.measurement.setting.options = command.options;
  if (command.impacts && scene_.frames == 1)
    throw Bad_argument("--impacts is about what happens between frames, and there is one only");
  refuse_questions_about_pairs(scene_, command);
  if (command.merge_shards) return;  // others have played the frames
  asks_once_ = asks_once(command, scene_);
  if (command.options.mode == Mode::certified) compute_motions();
  if (!asks_once_) make_detector();
  if (!command.html.empty()) page_.emplace(command, scene_, *detector_);
  if (!command.paraview.empty()) paraview_.emplace(command.paraview, scene_.frames, command.options.mode);
}

std::size_t Detect_run::joined_vertices(Object_id id) const {
  return finds_all(command_.options.mode) || !detector_ ? 0 : detector_->object(id).joined_vertices();
}

/// What need not be posed as a whole is posed by the detector, where it looks.
void Detect_run::compute_motions() {
  for (const auto& object : scene_.objects)
    computed_.push_back(object.motion.computed ? object.motion.computed(object.file_vertex) : nullptr);
}

void Detect_run::make_detector() {
  detector_.emplace(detector_options(command_), make_strategy(command_.partition.name, command_.partition.settings));
  for (std::size_t number = 0; number < scene_.objects.size(); ++number) {
    auto& object = scene_.objects[number];
    Object_options options = object_options(object);
    if (command_.chooses_particles) options.particles = 0;
    if (number < computed_.size() && computed_[number])
      detector_->add(object.mesh, point_map(object.mesh, *computed_[number]), options);
    else
      detector_->add(object.mesh, options);
  }
  for (const auto& pair : scene_.ignored) detector_->ignore(pair.a, pair.b);
}

const Frame& Detect_run::detect() {
  if (asks_once_) {
    only_frame_ = frame_at_once(scene_.objects[0].mesh, scene_.objects[1].mesh, command_.options);
    if (only_frame_) return *only_frame_;
    make_detector();
  }
  detector_->update();
  return detector_->detect();
}

/// Moves all objects; only those meshes whose positions are read.
void Detect_run::pose_all(std::size_t frame) {
  const bool shown = command_.truth || !command_.html.empty() || !command_.paraview.empty();
  for (std::size_t number = 0; number < scene_.objects.size(); ++number) {
    const bool computed = number < computed_.size() && computed_[number];
    // A pose that stays would keep what earlier frames have found out about it.
    if (computed && command_.independent_frames) computed_[number]->set_frame(0);
    if (computed) computed_[number]->set_frame(frame);
    if (computed && !shown) continue;
    auto& object = scene_.objects[number];
    if (frame > 0 && frame == frame_ahead_)
      move_to(ahead_[number], object.mesh);
    else
      pose(object, frame);
  }
}

void Detect_run::warm_up(std::size_t frame) {
  pose_all(frame);
  detect();
}

std::string Detect_run::play(std::size_t frame) {
  pose_all(frame);
  const Frame& result = detect();
  tally_ = {.frame = frame, .pairs = result.pairs, .statistics = result.statistics};
  if (paraview_) paraview_->add(frame, scene_, *detector_, result);
  const auto truth = find_truth();
  if (truth) compare(result, *truth);
  const auto closest = find_closest();
  if (closest)
    for (const auto& [pair, found] : *closest) tally_.distances.push_back({pair, found.points.distance});
  const auto impacts = find_impacts(frame);
  if (impacts)
    for (const auto& [pair, impact] : *impacts) tally_.impacts.push_back({pair, impact.time});
  add(tally_);
  const Frame_findings findings{.frame = result, .truth = truth, .closest = closest, .impacts = impacts};
  std::string line = frame_line(frame, scene_.objects, findings, command_.options, command_.independent_frames);
  if (page_) page_->add(frame, result, line, any_truth(truth));
  return line;
}

void Detect_run::add(const Frame_tally& tally) {
  // The first frame builds, and finds all positions outside the caches.
  summary_.add(tally, tally.frame > 0 || scene_.frames == 1);
  contradicted_ |= tally.contradicted;
  missed_ |= tally.missed;
}

/// Whether any surfaces intersect, if exhaustive checking decides it: it does not check for self-collisions.
std::optional<bool> Detect_run::any_truth(const std::optional<std::vector<Pair_truth>>& truth) const {
  if (!truth || command_.options.exact.self_collision) return std::nullopt;
  return std::ranges::any_of(*truth, [](const auto& pair) { return !pair.faces.empty(); });
}

/// Calls `visit` with each pair of two objects that may collide.
template <class Visit>
void Detect_run::for_each_pair(const Visit& visit) const {
  for (Object_id a = 0; a < scene_.objects.size(); ++a)
    for (Object_id b = a + 1; b < scene_.objects.size(); ++b)
      if (!scene_.ignores({a, b})) visit(a, b);
}

std::optional<std::vector<Pair_truth>> Detect_run::find_truth() const {
  if (!command_.truth) return std::nullopt;
  std::vector<Surface_now> surfaces;
  surfaces.reserve(scene_.objects.size());
  for (const auto& object : scene_.objects) surfaces.emplace_back(object.mesh);
  std::vector<Pair_truth> truth;
  for_each_pair([&](Object_id a, Object_id b) {
    auto& faces = truth.emplace_back(Pair_truth{{a, b}, {}}).faces;
    const auto &one = surfaces[a], &other = surfaces[b];
    if (one.box.intersects(other.box))
      faces = exhaustive_numbered(one.positions, one.numbering.corners(), other.positions, other.numbering.corners());
  });
  return truth;
}

std::optional<std::vector<Pair_closest>> Detect_run::find_closest() {
  if (!command_.closest) return std::nullopt;
  std::vector<Pair_closest> closest;
  for_each_pair([&](Object_id a, Object_id b) { closest.push_back({{a, b}, detector_->closest(a, b)}); });
  return closest;
}

/// None in the last frame, which has no next one.
std::optional<std::vector<Object_impact>> Detect_run::find_impacts(std::size_t frame) {
  if (!command_.impacts || frame + 1 == scene_.frames) return std::nullopt;
  frame_ahead_ = 0;
  ahead_ = positions_in(scene_, frame + 1);
  frame_ahead_ = frame + 1;
  return detector_->first_impacts(ahead_);
}

void Detect_run::compare(const Frame& result, const std::vector<Pair_truth>& truth) {
  for (const auto& [pair, faces] : truth) {
    const Pair_result* found = listed(result, pair);
    const bool seen = found != nullptr && found->collides;
    tally_.scores.push_back({pair, !faces.empty(), seen});
    tally_.missed |= !faces.empty() && !seen;
    if (found == nullptr) continue;
    tally_.contradicted |= found->collides && faces.empty();
    std::vector<Face_pair> intersecting;
    for (std::size_t i = found->first_contact; i < found->first_contact + found->contacts; ++i)
      if (result.intersects(i)) intersecting.push_back(result.face_pairs[i]);
    tally_.contradicted |= !std::ranges::includes(faces, intersecting);
    if (command_.options.contacts == Contact_query::all && !found->capped)
      tally_.missed |= !std::ranges::includes(intersecting, faces);
  }
}

}  // namespace lodestone
