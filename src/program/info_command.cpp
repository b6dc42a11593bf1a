// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "io/files/small_text.h"
#include "lodestone/io/meshes/file_faces.h"
#include "lodestone/io/motion/animation.h"
#include "lodestone/io/results/surface_report.h"
#include "lodestone/io/results/text_table.h"
#include "lodestone/io/scenes/given_objects.h"
#include "lodestone/queries/contact_search.h"
#include "program/commands.h"
#include "program/exit_codes.h"
#include "program/frame_log.h"
#include "program/progress.h"

namespace lodestone {

namespace {

using Json = nlohmann::ordered_json;

/// More pairs than anyone reads. A surface folded onto itself can have billions.
constexpr std::size_t most_intersections = 1'000'000;

/// One object in its first frame.
struct Object_report {
  std::string name;
  std::size_t frames = 0;                      ///< 0: any number
  std::size_t vertices = 0;                    ///< of the file
  File_faces faces = {};                       ///< of the file
  std::optional<Surface_report> surface = {};  ///< missing for a point cache without its mesh
  Box box = {};                                ///< for a point cache without its mesh: of all vertices, used or not
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
  std::vector<double> coordinates;
  for (const auto& p : points) coordinates.insert(coordinates.end(), {p.x(), p.y(), p.z()});
  Tree_surface object(faces);
  object.build({}, coordinates, {});
  Workers workers(0);
  Contact_search search(workers);
  std::vector<Face_pair> found;
  report.capped = search.within(object, {.most = most_intersections}, found).capped;
  report.self_intersections = found.size();
}

Object_report report_of(const std::string& name, const Animation& animation) {
  Object_report report{.name = name, .frames = animation.motion.frames, .vertices = animation.vertices};
  std::vector<Point> points(animation.vertices);
  animation.motion.pose(0, points);
  if (animation.faces.empty()) {
    for (const Point& point : points) report.box.extend(coordinates(point));
    return report;
  }
  report.surface = inspect_surface(points, animation.faces);
  report.faces = count_file_faces(animation.file_face);
  count_self_intersections(points, animation.faces, report);
  return report;
}

/// Uses file vertices, so that copies of a vertex count as one.
Object_report report_of(Scene_object& object) {
  pose(object, 0);  // refuses coordinates that are not finite
  auto report = report_of(object.name, animation_of(object, 1));
  report.frames = object.motion.frames;
  return report;
}

Info look_at(const Info_command& command) {
  if (command.file.extension() == ".json") {
    Scene scene = read_scene(command.file, {.allow_outside = command.allow_outside});
    Info info{.kind = "scene", .frames = scene.frames};
    for (auto& object : scene.objects) {
      info.objects.push_back(report_of(object));
      check_interrupt();
    }
    return info;
  }
  const auto animation = read_animation(command.file, {.mesh = command.mesh});
  return {.kind = animation.kind,
          .frames_per_second = animation.frames_per_second,
          .frames = animation.motion.frames,
          .objects = {report_of(command.file.filename().string(), animation)}};
}

Json box_json(const Box& box) {
  if (box.isEmpty()) return nullptr;
  const auto corner = [](const Eigen::Vector3d& p) { return Json{p.x(), p.y(), p.z()}; };
  return {corner(box.min()), corner(box.max())};
}

Json to_json(const Object_report& report) {
  Json json{{"name", report.name}, {"vertices", report.vertices}};
  if (report.frames > 0) json["frames"] = report.frames;
  if (!report.surface) {
    json["box"] = box_json(report.box);
    return json;
  }
  const auto& surface = *report.surface;
  json["faces"] = report.faces.count;
  json["triangles"] = surface.faces;
  json.update({{"components", surface.components},
               {"closed", surface.closed},
               {"border_edges", surface.border_edges},
               {"non_manifold_edges", surface.non_manifold_edges},
               {"degenerate_faces", surface.degenerate_faces},
               {"duplicate_vertices", surface.duplicate_vertices},
               {"unused_vertices", surface.unused_vertices},
               {"self_intersections", report.self_intersections}});
  if (report.capped) json["self_intersections_capped"] = true;
  json["box"] = box_json(surface.box);
  return json;
}

std::string box_text(const Box& box) {
  if (box.isEmpty()) return "none";
  const auto corner = [](const Eigen::Vector3d& p) {
    return fmt::format("({:.6g} {:.6g} {:.6g})", p.x(), p.y(), p.z());
  };
  return corner(box.min()) + " to " + corner(box.max());
}

void print(const Object_report& report, const std::string& kind) {
  Text_table table({printable(report.name), kind});
  const auto add = [&](const char* what, std::size_t count) { table.add({what, std::to_string(count)}); };
  if (report.frames > 0) add("frames", report.frames);
  add("vertices", report.vertices);
  if (!report.surface) {
    table.add({"box", box_text(report.box)});
    fmt::print("{}", table.text());
    return;
  }
  const auto& surface = *report.surface;
  add("faces", report.faces.count);
  if (report.faces.cut > 0) {
    add("faces of more than three corners", report.faces.cut);
    add("triangles", surface.faces);
  }
  add("components", surface.components);
  table.add({"surface", surface.closed ? "closed" : "open"});
  add("border edges", surface.border_edges);
  add("non-manifold edges", surface.non_manifold_edges);
  add("degenerate faces", surface.degenerate_faces);
  add("duplicate vertices", surface.duplicate_vertices);
  add("unused vertices", surface.unused_vertices);
  table.add({"self-intersections (face pairs)",
             fmt::format("{}{}", report.self_intersections, report.capped ? " or more" : "")});
  table.add({"box", box_text(surface.box)});
  fmt::print("{}", table.text());
}

}  // namespace

int run(const Info_command& command) {
  const Info info = look_at(command);
  if (command.json) {
    Json json{{"file", command.file.filename().string()}, {"kind", info.kind}, {"frames", info.frames}};
    if (info.frames_per_second > 0) json["frames_per_second"] = info.frames_per_second;
    json["objects"] = Json::array();
    for (const auto& object : info.objects) json["objects"].push_back(to_json(object));
    fmt::print("{}", json_text(json, 2));
    return exit_code::success;
  }
  if (info.kind == "scene")
    fmt::print("{}: {}, {}\n\n", printable(command.file.filename().string()), counted(info.objects.size(), "object"),
               counted(info.frames, "frame"));
  for (std::size_t i = 0; i < info.objects.size(); ++i) {
    if (i > 0) fmt::print("\n");
    print(info.objects[i], info.kind == "scene" ? "object" : info.kind);
  }
  return exit_code::success;
}

}  // namespace lodestone
