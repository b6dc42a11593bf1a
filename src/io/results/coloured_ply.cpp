// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/results/coloured_ply.h"

#include <fmt/format.h>

#include <string>

#include "io/files/byte_order.h"
#include "io/results/region_colour.h"
#include "lodestone/io/files/atomic_file.h"

namespace lodestone {

void write_coloured_ply(const std::filesystem::path& file, const Surface_mesh& mesh,
                        const std::vector<Region_index>& regions) {
  std::vector<double> coordinates;
  for (const auto v : mesh.vertices())
    for (int axis = 0; axis < 3; ++axis) coordinates.push_back(mesh.point(v)[axis]);
  std::vector<Corners> faces;
  for (const auto f : mesh.faces()) {
    auto corner = faces.emplace_back().begin();
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) *corner++ = v;
  }
  write_coloured_ply(file, coordinates, faces, regions);
}

void write_coloured_ply(const std::filesystem::path& file, Coordinates coordinates, std::span<const Corners> faces,
                        std::span<const Region_index> regions) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment regions of a partition by Lodestone\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty int region\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      regions.size(), faces.size());
  for (std::size_t v = 0; v < regions.size(); ++v) {
    for (const double coordinate : coordinates.subspan(3 * v, 3)) append(bytes, coordinate);
    for (const auto channel : region_colour(regions[v])) append(bytes, channel);
    append(bytes, static_cast<std::int32_t>(regions[v]));
  }
  for (const auto& corners : faces) {
    append(bytes, std::uint8_t{3});
    for (const auto corner : corners) append(bytes, static_cast<std::int32_t>(corner));
  }
  write_whole(file, bytes);
}

}  // namespace lodestone
