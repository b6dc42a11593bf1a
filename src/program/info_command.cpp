// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "io/files/small_text.h"
#include "io/motion/animation_names.h"
#include "lodestone/io/meshes/file_faces.h"
#include "lodestone/io/motion/animation.h"
#include "lodestone/io/results/component_orientation.h"
#include "lodestone/io/results/surface_report.h"
#include "lodestone/io/results/text_table.h"
#include "lodestone/io/scenes/given_objects.h"
#include "lodestone/queries/contact_search.h"
#include "mesh/coordinates_of.h"
#include "program/commands.h"
#include "program/exit_codes.h"
#include "program/frame_log.h"
#include "program/mesh_beside.h"
#include "program/progress.h"
#include "program/standard_input.h"

namespace lodestone {

namespace {

using Json = nlohmann::ordered_json;

/// More pairs than anyone reads. A surface folded onto itself can have billions.
constexpr std::size_t most_intersections = 1'000'000;

/// Components that `--json` lists, at most. A mesh without shared vertices has one per face.
constexpr std::size_t most_components = 1000;

/// One object in its first frame, and the space that it takes in all frames.
struct Object_report {
  std::string name;
  std::size_t frames = 0;                      ///< 0: any number
  std::size_t vertices = 0;                    ///< of the file
  File_faces faces = {};                       ///< of the file
  std::optional<Surface_report> surface = {};  ///< missing for a point cache without its mesh
  std::vector<Component_orientation> components = {};
  std::vector<std::string> parts = {};  ///< that the file names, each once
  File_animations animations = {};      ///< no names: the format has none
  std::set<std::string> not_read = {};  ///< what else the file holds
  Box box = {};  ///< of the vertices that faces use; for a point cache without its mesh: of all vertices
  Box box_of_all_frames = {};
  std::size_t self_intersections = 0;
  bool capped = false;
};

struct Info {
  std::string kind;
  double frames_per_second = 0;
  std::size_t frames = 0;
  std::vector<Object_report> objects = {};
};

/// Number of face pairs that intersect outside what they share, by exact tests. Uses file vertices: where the mesh has
/// copies of a non-manifold vertex, faces that share the vertex would count as touching.
void count_self_intersections(std::span<const Point> points, std::span<const Corners> faces, Object_report& report) {
  if (faces.empty()) return;
  const std::vector<double> coordinates = coordinates_of(points);
  Tree_surface object(faces);
  object.build({}, coordinates, {});
  Workers workers(0);
  Contact_search search(workers);
  std::vector<Face_pair> found;
  report.capped = search.within(object, {.most = most_intersections}, found).capped;
  report.self_intersections = found.size();
}

/// Of the vertices that faces use; of all vertices if there are no faces.
Box box_of(std::span<const Point> points, std::span<const Corners> faces) {
  Box box;
  for (const auto& face : faces)
    for (const auto vertex : face) box.extend(coordinates(points[vertex]));
  if (faces.empty())
    for (const Point& point : points) box.extend(coordinates(point));
  return box;
}

void find_boxes(const Animation& animation, Object_report& report) {
  std::vector<Point> points(animation.vertices);
  for (std::size_t frame = 0; frame < animation.motion.frames; ++frame) {
    animation.motion.pose(frame, points);
    const Box box = box_of(points, animation.faces);
    if (frame == 0) report.box = box;
    report.box_of_all_frames.extend(box);
    check_interrupt();
  }
}

/// Those with faces, in the order of the file.
std::vector<std::string> part_names(const File_parts& parts, std::size_t faces) {
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const auto& [name, first_face] : parts)
    if (!name.empty() && first_face < faces && seen.insert(name).second) names.push_back(name);
  return names;
}

Object_report report_of(const std::string& name, const Animation& animation) {
  Object_report report{.name = name, .frames = animation.motion.frames, .vertices = animation.vertices};
  report.animations = animation.motion.animations;
  report.not_read = animation.not_read;
  report.not_read.insert(animation.ignored_extensions.begin(), animation.ignored_extensions.end());
  find_boxes(animation, report);
  if (animation.faces.empty()) return report;
  std::vector<Point> points(animation.vertices);
  animation.motion.pose(0, points);
  check_interrupt();
  report.surface = inspect_surface(points, animation.faces);
  report.faces = count_file_faces(animation.file_face);
  report.parts = part_names(animation.parts, report.faces.count);
  if (!report.parts.empty()) report.not_read.erase("groups");  // they are listed
  check_interrupt();
  report.components = component_orientations(points, animation.faces, animation.file_face);
  check_interrupt();
  count_self_intersections(points, animation.faces, report);
  return report;
}

/// Uses file vertices, so that copies of a vertex count as one.
/// @param frames  of the scene
Object_report report_of(Scene_object& object, std::size_t frames) {
  auto animation = animation_of(object, frames);
  animation.motion.frames = frames;
  animation.motion.pose = [&object](std::size_t frame, std::span<Point> positions) {
    pose(object, frame);  // refuses coordinates that are not finite
    object.motion.pose(frame, positions);
  };
  auto report = report_of(object.name, animation);
  report.frames = object.motion.frames;
  return report;
}

Info look_at(const Info_command& command) {
  if (auto object = named_object(command.file, command.reading)) {
    refuse_mesh_beside(command.file, command.mesh);
    const std::size_t frames = std::max<std::size_t>(1, object->motion.frames);
    return {.kind = "object", .frames = frames, .objects = {report_of(*object, frames)}};
  }
  if (lower_case(command.file.extension().string()) == ".json") {
    refuse_mesh_beside(command.file, command.mesh);
    Scene scene = read_scene(command.file, command.reading);
    Info info{.kind = "scene", .frames = scene.frames};
    for (auto& object : scene.objects) info.objects.push_back(report_of(object, scene.frames));
    return info;
  }
  const auto animation = read_animation(command.file, {.mesh = command.mesh, .limits = command.reading.limits});
  return {.kind = animation.kind,
          .frames_per_second = animation.frames_per_second,
          .frames = animation.motion.frames,
          .objects = {report_of(shown_name(command.file), animation)}};
}

using Kind_count = std::pair<std::size_t, std::optional<Component_orientation>>;

/// How many components are oriented so, and the first of them.
Kind_count count_kind(std::span<const Component_orientation> components, Face_orientation kind) {
  Kind_count found;
  for (const auto& component : components) {
    if (component.orientation != kind) continue;
    if (found.first++ == 0) found.second = component;
  }
  return found;
}

Json orientation_json(std::span<const Component_orientation> components) {
  Json json = Json::object();
  for (const auto kind : face_orientations)
    if (const auto count = count_kind(components, kind).first; count > 0)
      json[std::string(words_of(kind).name)] = count;
  return json;
}

Json component_list_json(std::span<const Component_orientation> components) {
  Json json = Json::array();
  for (const auto& component : components.first(std::min(components.size(), most_components)))
    json.push_back({{"first_face", component.first_face},
                    {"faces", component.faces},
                    {"orientation", words_of(component.orientation).name}});
  return json;
}

/// `3 components outward, 1 inward (first face 1203)`; of one component its orientation alone.
std::string orientation_text(std::span<const Component_orientation> components) {
  if (components.size() == 1) return std::string(words_of(components[0].orientation).phrase);
  std::string text;
  for (const auto kind : face_orientations) {
    const auto [count, first] = count_kind(components, kind);
    if (!first) continue;
    text += text.empty() ? counted(count, "component") : fmt::format(", {}", count);
    text += fmt::format(" {}", words_of(kind).phrase);
    if (kind != Face_orientation::outward) text += fmt::format(" (first face {})", first->first_face);
  }
  return text.empty() ? "none" : text;
}

Json box_json(const Box& box) {
  if (box.isEmpty()) return nullptr;
  const auto corner = [](const Eigen::Vector3d& p) { return Json{p.x(), p.y(), p.z()}; };
  return {corner(box.min()), corner(box.max())};
}

Json to_json(const Object_report& report) {
  Json json{{"name", report.name}, {"vertices", report.vertices}};
  if (report.frames > 0) json["frames"] = report.frames;
  if (const auto& [names, played, is_chosen] = report.animations; !names.empty())
    json.update({{"animations", names}, {"played_animation", played}});
  if (!report.not_read.empty()) json["not_read"] = report.not_read;
  const auto add_boxes = [&] {
    json["box"] = box_json(report.box);
    json["box_of_all_frames"] = box_json(report.box_of_all_frames);
  };
  if (!report.surface) {
    add_boxes();
    return json;
  }
  const auto& surface = *report.surface;
  json["faces"] = report.faces.count;
  json["triangles"] = surface.faces;
  if (!report.parts.empty()) json["parts"] = report.parts;
  json.update({{"components", surface.components},
               {"closed", surface.closed},
               {"border_edges", surface.border_edges},
               {"non_manifold_edges", surface.non_manifold_edges},
               {"degenerate_faces", surface.degenerate_faces},
               {"duplicate_vertices", surface.duplicate_vertices},
               {"unused_vertices", surface.unused_vertices},
               {"self_intersections", report.self_intersections}});
  if (report.capped) json["self_intersections_capped"] = true;
  json["orientation"] = orientation_json(report.components);
  json["component_list"] = component_list_json(report.components);
  if (report.components.size() > most_components) json["component_list_capped"] = true;
  add_boxes();
  return json;
}

/// With all digits: the shortest texts that are read back as the same numbers.
std::string box_text(const Box& box) {
  if (box.isEmpty()) return "none";
  const auto corner = [](const Eigen::Vector3d& p) { return fmt::format("({} {} {})", p.x(), p.y(), p.z()); };
  return corner(box.min()) + " to " + corner(box.max());
}

/// The first few names, and how many there are more.
std::string part_list(std::span<const std::string> names) {
  constexpr std::size_t most = 8;
  std::vector<std::string> listed;
  for (const auto& name : names.first(std::min(names.size(), most))) listed.push_back(printable(name));
  const auto more = names.size() > most ? fmt::format(", and {} more", names.size() - most) : "";
  return fmt::format("{}{}", fmt::join(listed, ", "), more);
}

/// @param frames  that the boxes of all frames span
void print(const Object_report& report, const std::string& kind, std::size_t frames) {
  Text_table table({printable(report.name), kind});
  const auto add = [&](const char* what, std::size_t count) { table.add({what, std::to_string(count)}); };
  if (report.frames > 0) add("frames", report.frames);
  if (const auto& [names, played, is_chosen] = report.animations; !names.empty()) {
    table.add({"animations", animation_list(names)});
    table.add({"animation that is played", animation_name(names, played)});
  }
  if (!report.not_read.empty()) table.add({"not read", fmt::format("{}", fmt::join(report.not_read, ", "))});
  add("vertices", report.vertices);
  const auto finish = [&] {
    table.add({frames > 1 ? "box of the first frame" : "box", box_text(report.box)});
    const bool goes_on = report.frames > frames;  // than the scene
    const auto all = goes_on ? fmt::format("box of the first {} frames", frames) : "box of all frames";
    if (frames > 1) table.add({all, box_text(report.box_of_all_frames)});
    fmt::print("{}", table.text());
  };
  if (!report.surface) return finish();
  const auto& surface = *report.surface;
  add("faces", report.faces.count);
  if (report.faces.cut > 0) {
    add("faces of more than three corners", report.faces.cut);
    add("triangles", surface.faces);
  }
  if (!report.parts.empty()) table.add({"parts", part_list(report.parts)});
  add("components", surface.components);
  table.add({"surface", surface.closed ? "closed" : "open"});
  table.add({"orientation", orientation_text(report.components)});
  add("border edges", surface.border_edges);
  add("non-manifold edges", surface.non_manifold_edges);
  add("degenerate faces", surface.degenerate_faces);
  add("duplicate vertices", surface.duplicate_vertices);
  add("unused vertices", surface.unused_vertices);
  table.add({"self-intersections (face pairs)",
             fmt::format("{}{}", report.self_intersections, report.capped ? " or more" : "")});
  finish();
}

}  // namespace

int run(const Info_command& command) {
  const Info info = look_at(command);
  check_interrupt();
  if (command.json) {
    Json json{{"file", shown_name(command.file)}, {"kind", info.kind}, {"frames", info.frames}};
    if (info.frames_per_second > 0) json["frames_per_second"] = info.frames_per_second;
    json["objects"] = Json::array();
    for (const auto& object : info.objects) json["objects"].push_back(to_json(object));
    fmt::print("{}", json_text(json, 2));
    return exit_code::success;
  }
  if (info.kind == "scene")
    fmt::print("{}: {}, {}\n\n", printable(shown_name(command.file)), counted(info.objects.size(), "object"),
               counted(info.frames, "frame"));
  for (std::size_t i = 0; i < info.objects.size(); ++i) {
    if (i > 0) fmt::print("\n");
    print(info.objects[i], info.kind == "scene" ? "object" : info.kind, info.frames);
  }
  return exit_code::success;
}

}  // namespace lodestone
