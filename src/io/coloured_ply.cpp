// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/coloured_ply.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>
#include <string>

#include "io/byte_order.h"
#include "lodestone/io/atomic_file.h"

namespace lodestone {

namespace {

using Colour = std::array<std::uint8_t, 3>;

/// Hues in steps of the golden section never come close to those just before them.
Colour region_colour(Region_index region) {
  const double hue = 6 * std::fmod(0.61803398874989485 * region, 1.0);
  const double lightness = 0.75 + 0.2 * static_cast<double>(region % 3) / 2;
  const auto channel = [&](double offset) {
    const double distance = std::abs(std::fmod(hue + offset, 6.0) - 3) - 1;
    return static_cast<std::uint8_t>(std::lround(255 * lightness * (0.25 + 0.75 * std::clamp(distance, 0.0, 1.0))));
  };
  return {channel(0), channel(4), channel(2)};
}

}  // namespace

void write_coloured_ply(const std::filesystem::path& file, const Surface_mesh& mesh,
                        const std::vector<Region_index>& regions) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment regions of a partition by Lodestone\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty int region\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.number_of_vertices(), mesh.number_of_faces());
  for (const auto v : mesh.vertices()) {
    for (int axis = 0; axis < 3; ++axis) append(bytes, mesh.point(v)[axis]);
    for (const auto channel : region_colour(regions[v])) append(bytes, channel);
    append(bytes, static_cast<std::int32_t>(regions[v]));
  }
  for (const auto f : mesh.faces()) {
    append(bytes, std::uint8_t{3});
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) append(bytes, static_cast<std::int32_t>(v));
  }
  Atomic_file out(file);
  out.write(bytes);
  out.commit();
}

}  // namespace lodestone
