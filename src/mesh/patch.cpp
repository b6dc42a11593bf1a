// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/patch.h"

#include <algorithm>

namespace lodestone {

Patch make_patch(std::vector<std::uint32_t> faces, std::span<const Corners> mesh_corners) {
  Patch patch{.faces = std::move(faces)};
  std::ranges::sort(patch.faces);
  patch.vertices.reserve(3 * patch.faces.size());
  for (const auto face : patch.faces)
    patch.vertices.insert(patch.vertices.end(), mesh_corners[face].begin(), mesh_corners[face].end());
  std::ranges::sort(patch.vertices);
  patch.vertices.erase(std::unique(patch.vertices.begin(), patch.vertices.end()), patch.vertices.end());

  const auto index = [&](std::uint32_t vertex) {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(patch.vertices, vertex) - patch.vertices.begin());
  };
  patch.corners.reserve(patch.faces.size());
  for (const auto face : patch.faces) {
    const auto& [a, b, c] = mesh_corners[face];
    patch.corners.push_back({index(a), index(b), index(c)});
  }
  return patch;
}

std::vector<Patch> region_patches(std::span<const Corners> mesh_corners, std::span<const Region_index> labels,
                                  std::size_t regions) {
  std::vector<std::vector<std::uint32_t>> faces(regions);
  for (std::uint32_t face = 0; face < mesh_corners.size(); ++face)
    for (const auto corner : mesh_corners[face]) {
      auto& list = faces[labels[corner]];
      if (list.empty() || list.back() != face) list.push_back(face);
    }
  std::vector<Patch> patches;
  patches.reserve(regions);
  for (auto& list : faces) patches.push_back(make_patch(std::move(list), mesh_corners));
  return patches;
}

}  // namespace lodestone
