// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/file_partition.h"

#include <chrono>

#include "io/scenes/object_of.h"
#include "lodestone/io/meshes/mesh_file.h"
#include "mesh/coordinates_of.h"

namespace lodestone {

namespace {

/// Per region: how many vertices of it faces name.
std::vector<std::size_t> count_named(std::span<const Corners> faces, std::span<const Region_index> labels,
                                     std::size_t regions) {
  std::vector<std::size_t> sizes(regions);
  std::vector<bool> counted(labels.size());
  for (const auto& corners : faces)
    for (const auto v : corners) {
      if (!counted[v]) ++sizes[labels[v]];
      counted[v] = true;
    }
  return sizes;
}

}  // namespace

File_surface file_surface(const Animation& animation, std::size_t frame) {
  std::vector<Point> points(animation.vertices);
  animation.motion.pose(frame, points);
  return {.coordinates = coordinates_of(points), .faces = animation.faces, .joined = animation.motion.joined};
}

void orient(File_surface& surface) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < surface.coordinates.size(); i += 3)
    points.emplace_back(surface.coordinates[i], surface.coordinates[i + 1], surface.coordinates[i + 2]);
  surface.faces = detail::file_corners(detail::object_of(mesh_of(points, surface.faces, "mesh")));
}

File_partition divide(const File_surface& surface, std::size_t regions, const Any_strategy& strategy,
                      const Partition_options& options) {
  const Indexed_mesh mesh(surface.coordinates, surface.faces);
  const auto map = Region_property<Indexed_mesh>::add(mesh, "");
  const auto start = std::chrono::steady_clock::now();
  File_partition result;
  result.partition = partition(mesh, regions, map, strategy, options);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.measures = measure_partition(mesh, result.partition, map);
  result.labels.assign(map.storage_begin(), map.storage_end());
  result.sizes = count_named(surface.faces, result.labels, result.partition.regions);
  for (std::size_t v = 0; v < surface.joined.size(); ++v) result.labels[v] = result.labels[surface.joined[v]];
  return result;
}

}  // namespace lodestone
