// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "io/files/small_text.h"
#include "lodestone/io/files/atomic_file.h"
#include "lodestone/io/meshes/file_faces.h"
#include "lodestone/io/results/coloured_ply.h"
#include "lodestone/io/results/text_table.h"
#include "lodestone/io/scenes/given_objects.h"
#include "lodestone/mesh/joined_vertices.h"
#include "program/commands.h"
#include "program/exit_codes.h"
#include "program/file_partition.h"
#include "program/frame_log.h"
#include "program/measures_json.h"
#include "program/notes.h"
#include "program/page_file.h"
#include "program/progress.h"
#include "program/standard_input.h"

namespace lodestone {

namespace {

using Json = nlohmann::ordered_json;

/// Per vertex of the file: its region; null for a vertex that no face names and that doubles no other.
Json labels_json(const File_surface& surface, const File_partition& divided) {
  Json labels = divided.labels;
  for (const auto v : unused_vertices(surface.faces, static_cast<std::uint32_t>(labels.size())))
    if (surface.joined.empty() || surface.joined[v] == v) labels[v] = nullptr;
  return labels;
}

Json statistics(const Scene_object& object, const File_surface& surface, const File_partition& divided,
                const Partition_command& command) {
  const auto& statistics = divided.partition.statistics;
  return {{"mesh", shown_name(command.mesh)},
          {"strategy", command.strategy.name},
          {"seed", command.strategy.settings.seed},
          {"vertices", object.file_vertices},
          {"faces", count_file_faces(object.file_face).count},
          {"triangles", object.mesh.number_of_faces()},
          {"regions_wanted", command.regions},
          {"regions", divided.partition.regions},
          {"region_sizes", divided.sizes},
          {"particles", divided.partition.particles},
          {"labels", labels_json(surface, divided)},
          {"iterations", statistics.iterations},
          {"distance_evaluations", statistics.distance_evaluations},
          {"parts_before_repair", statistics.repair.parts_before},
          {"islands_joined", statistics.repair.islands_joined},
          {"regions_added", statistics.repair.regions_added},
          {"measures", to_json(divided.measures)},
          {"seconds", divided.seconds}};
}

/// The mesh as a page of one frame, with each particle at its start vertex.
Page page_of(const Scene_object& object, const File_surface& surface, const File_partition& divided,
             const Partition_command& command) {
  const Mesh_numbering numbering(object.mesh);
  const auto corners = numbering.corners();
  std::vector<Region_index> labels;                              // per vertex of the mesh
  std::vector<std::uint32_t> mesh_vertex(object.file_vertices);  // the last of its copies
  for (std::uint32_t v = 0; v < numbering.vertex_count(); ++v) {
    labels.push_back(divided.labels[object.file_vertex[v]]);
    mesh_vertex[object.file_vertex[v]] = v;
  }
  std::vector<std::uint32_t> starts;
  for (const auto v : divided.partition.particles) starts.push_back(mesh_vertex[v]);
  Json numbers = statistics(object, surface, divided, command);
  numbers.erase("seconds");  // so that equal partitions give equal pages
  numbers.erase("labels");   // the page has them
  Page page({.kind = Page_kind::partition, .title = shown_name(command.mesh), .strategy = command.strategy.name});
  page.set_regions(
      page.add_object(command.mesh.stem().string(), numbering.vertex_count(), {corners.begin(), corners.end()}),
      labels);
  page.add_frame({.positions = {read_positions(numbering, object.mesh.points())},
                  .particles = {starts},
                  .numbers = json_text(numbers)});
  return page;
}

void print_table(const Scene_object& object, const File_partition& divided, const Partition_command& command) {
  const auto& statistics = divided.partition.statistics;
  const auto [smallest, largest] = std::ranges::minmax(divided.sizes);
  Text_table table({printable(shown_name(command.mesh)), command.strategy.name});
  table.add({"vertices", std::to_string(object.file_vertices)});
  table.add({"faces", std::to_string(count_file_faces(object.file_face).count)});
  table.add({"regions", std::to_string(divided.partition.regions)});
  table.add({"smallest region (vertices)", std::to_string(smallest)});
  table.add({"largest region (vertices)", std::to_string(largest)});
  table.add({"iterations", std::to_string(statistics.iterations)});
  table.add({"distance evaluations", std::to_string(statistics.distance_evaluations)});
  table.add({"islands joined", std::to_string(statistics.repair.islands_joined)});
  const auto& measures = divided.measures;
  table.add({"distortion", fmt::format("{:.6f}", measures.distortion)});
  table.add({"border length / sqrt(area)", fmt::format("{:.2f}", measures.border_length)});
  table.add({"normal deviation (degrees)", fmt::format("{:.1f}", measures.normal_deviation)});
  table.add({"geodesic radius / object's", fmt::format("{:.3f}", measures.geodesic_radius)});
  table.add({"balls / object's ball (volume)", fmt::format("{:.3f}", measures.ball_volume)});
  table.add({"seconds", fmt::format("{:.4f}", divided.seconds)});
  fmt::print("{}", table.text());
  if (!command.out.empty()) fmt::print("\ncoloured mesh: {}\n", printable(command.out.string()));
}

void check_results_differ(const Partition_command& command) {
  std::error_code unknown;
  if (!command.out.empty() && weakly_canonical(command.out, unknown) == weakly_canonical(command.json, unknown))
    throw Bad_argument(command.out.string() + ": the coloured mesh and its statistics cannot be the same file");
}

/// No result may take the place of a file that is read.
void check_input_is_kept(const Partition_command& command, const std::vector<std::filesystem::path>& inputs) {
  std::error_code unknown;
  for (const auto* result : {&command.out, &command.json})
    for (const auto& input : inputs)
      if (!result->empty() && weakly_canonical(*result, unknown) == weakly_canonical(input, unknown))
        throw Bad_argument(result->string() + ": is a file of the mesh that is read, which is never overwritten");
}

/// An object of a scene, a shape, or what a file has, in its first frame.
Scene_object read_input(const Partition_command& command) {
  auto object = named_object(command.mesh, command.reading);
  if (!object && lower_case(command.mesh.extension().string()) == ".json")
    object = object_of_scene(command.mesh, "", command.reading);
  if (!object) object = read_object("", command.mesh, command.reading.limits);
  check_input_is_kept(command, object->files);
  pose(*object, 0);
  return std::move(*object);
}

}  // namespace

int run(const Partition_command& command) {
  if (!command.out.empty() && lower_case(command.out.extension().string()) != ".ply")
    throw Bad_argument(command.out.string() + ": the coloured mesh is written as .ply");
  if (command.json == "-") throw Bad_argument("--json writes a file: give it a name");
  check_results_differ(command);
  std::optional<Page_file> page;
  if (!command.html.empty()) page.emplace(command.html, command.json);
  const Scene_object object = read_input(command);
  const File_surface surface = file_surface(animation_of(object, 1), 0);
  const auto strategy = make_strategy(command.strategy.name, command.strategy.settings);
  const auto divided = divide(surface, command.regions, strategy, command.options);
  check_interrupt();
  // Both on disk before the first appears: if one cannot be written, neither appears.
  std::optional<Atomic_file> json;
  if (!command.json.empty()) {
    json.emplace(command.json);
    json->write(json_text(statistics(object, surface, divided, command), 2));
    json->finish();
  }
  if (page) page->finish(page_of(object, surface, divided, command));
  if (!command.out.empty()) write_coloured_ply(command.out, surface.coordinates, surface.faces, divided.labels);
  if (json) json->commit();
  if (page) page->commit();
  if (!command.quiet) {
    const auto name = shown_name(command.mesh);
    note(ignored_extensions_note(name, object.ignored_extensions));
    note(cut_faces_note(name, object.file_face));
  }
  if (!command.quiet) print_table(object, divided, command);
  if (!command.quiet && page) fmt::print("\n{}\n", page->summary());
  return exit_code::success;
}

}  // namespace lodestone
