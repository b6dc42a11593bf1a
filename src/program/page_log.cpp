// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/page_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "io/results/page_frame.h"
#include "lodestone/io/scenes/object_options.h"
#include "program/scene_positions.h"

namespace lodestone {

namespace {

/// The options of the run with mode exact, which misses nothing.
Detector_options exact_question(const Detector_options& options) {
  Detector_options asked{.mode = Mode::exact, .contacts = Contact_query::yes_no, .exact = options.exact};
  asked.exact.tolerance = asked.exact.self_tolerance = 0;
  asked.exact.containment = asked.exact.parting = asked.exact.patches = false;
  return asked;
}

Page_head head_of(const Detect_command& command, const Scene& scene, std::size_t frame_step) {
  const Mode mode = command.options.mode;
  Page_head head{.title = scene.name,
                 .mode = std::string(name_of(mode)),
                 .frame_step = frame_step,
                 .first_contacts = command.options.contacts == Contact_query::first,
                 .note = missing_note(command.options, particle_setting(command, scene))};
  if (mode == Mode::certified)
    head.states = {"far", "bounded", "posed"};
  else if (makes_regions(command.options, scene))
    head.strategy = command.partition.name;
  return head;
}

std::size_t vertices_of(const Scene& scene) {
  std::size_t vertices = 0;
  for (const auto& object : scene.objects) vertices += object.mesh.number_of_vertices();
  return vertices;
}

Triangle triangle_of(const Surface_mesh& mesh, const Corners& corners) {
  const auto point = [&](std::uint32_t vertex) { return mesh.point(Surface_mesh::Vertex_index(vertex)); };
  return {point(corners[0]), point(corners[1]), point(corners[2])};
}

}  // namespace

Page_log::Page_log(const Detect_command& command, const Scene& scene, const Scene_detector& detector)
    : command_(command),
      scene_(scene),
      detector_(detector),
      exact_(exact_question(command.options)),
      frame_step_(page_frame_step(scene.frames, vertices_of(scene), command.html_frames)),
      page_(head_of(command, scene, frame_step_)),
      file_(command.html, command.out) {
  for (const auto& object : scene.objects) {
    const Mesh_numbering<Surface_mesh> numbering(object.mesh);
    const auto corners = numbering.corners();
    page_.add_object(object.name, numbering.vertex_count(), {corners.begin(), corners.end()});
    exact_.add(object.mesh, object_options(object));
  }
  for (const auto& pair : scene.ignored) exact_.ignore(pair.a, pair.b);
}

void Page_log::add(std::size_t frame, const Frame& result, const std::string& line, std::optional<bool> truth) {
  if (frame % frame_step_ != 0) return;
  const Detector_options& options = command_.options;
  set_regions();
  Page_frame shown{.positions = {}, .particles = particles(), .numbers = line, .stages = stages(result, truth)};
  for (const auto& object : scene_.objects) shown.positions.push_back(positions_of(object.mesh));
  if (!finds_all(options.mode)) shown.candidates = result.candidates;
  if (options.contacts != Contact_query::yes_no)
    shown.contacts = page_contacts(result, [this](Object_id object, std::uint32_t face) {
      return triangle_of(scene_.objects[object].mesh, page_.corners(object)[face]);
    });
  page_.add_frame(std::move(shown));
}

/// What mode certified knows of the leaves at each vertex: the most of any.
std::vector<Region_index> Page_log::leaf_states(Object_id o) const {
  std::vector<Region_index> states(scene_.objects[o].mesh.number_of_vertices(), 0);
  const Bounded_surface& surface = *detector_.bounded(o);
  for (std::uint32_t leaf = 0; leaf < surface.layout().leaf_count(); ++leaf)
    for (const auto vertex : surface.layout().vertices(leaf))
      states[vertex] = std::max(states[vertex], static_cast<Region_index>(surface.leaf_state(leaf)));
  return states;
}

void Page_log::set_regions() {
  if (command_.options.mode == Mode::certified) {
    for (Object_id o = 0; o < scene_.objects.size(); ++o) page_.set_regions(o, leaf_states(o));
    return;
  }
  if (!makes_regions(command_.options, scene_)) return;
  for (Object_id o = 0; o < scene_.objects.size(); ++o) {
    const auto& regions = detector_.maps(o).region();
    std::vector<Region_index> labels;
    for (const auto v : scene_.objects[o].mesh.vertices()) labels.push_back(regions[v]);
    page_.set_regions(o, labels);
  }
}

std::vector<std::vector<std::uint32_t>> Page_log::particles() const {
  std::vector<std::vector<std::uint32_t>> at;
  if (finds_all(command_.options.mode)) return at;
  for (Object_id o = 0; o < scene_.objects.size(); ++o) at.push_back(detector_.object(o).particles().at);
  return at;
}

std::string Page_log::stages(const Frame& result, std::optional<bool> truth) {
  const bool positive = truth ? *truth : exact_.detect().collides();
  const auto distance = positive && !command_.options.exact.self_collision ? std::optional(0.0) : nearest();
  return page_stages(
      result, {.positive = positive, .with_tolerance = has_tolerance(command_.options.exact), .nearest = distance});
}

/// Distance of the two nearest objects. Skips pairs whose boxes are farther apart than the best distance so far.
std::optional<double> Page_log::nearest() {
  std::vector<Box> boxes(scene_.objects.size());
  for (Object_id o = 0; o < boxes.size(); ++o)
    for (const auto& p : scene_.objects[o].mesh.points()) boxes[o].extend(coordinates(p));
  std::vector<std::tuple<double, Object_id, Object_id>> gaps;
  for (Object_id a = 0; a < boxes.size(); ++a)
    for (Object_id b = a + 1; b < boxes.size(); ++b)
      if (!scene_.ignores({a, b})) gaps.emplace_back(distance_lower_bound(boxes[a], boxes[b]), a, b);
  std::ranges::sort(gaps);
  std::optional<double> least;
  for (const auto& [gap, a, b] : gaps) {
    if (least && gap >= *least) break;
    const double distance = exact_.closest(a, b).points.distance;
    least = std::min(distance, least.value_or(distance));
  }
  return least;
}

std::string Page_log::summary() const {
  if (frame_step_ == 1) return file_.summary() + "\n";
  return fmt::format("{}, {} of {} frames: one of every {} (see --html-frames)\n", file_.summary(), page_.frames(),
                     scene_.frames, frame_step_);
}

}  // namespace lodestone
