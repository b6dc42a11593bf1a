// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/patch.h"

#include <algorithm>

namespace lodestone {

namespace {

/// Lists in each patch the faces of its region, ascending.
void list_faces(std::span<const Corners> mesh_corners, std::span<const Region_index> labels,
                std::vector<Patch>& patches) {
  std::vector<std::size_t> counts(patches.size(), 0);
  const auto for_regions = [&](std::uint32_t face, const auto& visit) {
    const Region_index a = labels[mesh_corners[face][0]], b = labels[mesh_corners[face][1]],
                       c = labels[mesh_corners[face][2]];
    visit(a);
    if (b != a) visit(b);
    if (c != a && c != b) visit(c);
  };
  for (std::uint32_t face = 0; face < mesh_corners.size(); ++face)
    for_regions(face, [&](Region_index region) { ++counts[region]; });
  for (std::size_t region = 0; region < patches.size(); ++region) patches[region].faces.reserve(counts[region]);
  for (std::uint32_t face = 0; face < mesh_corners.size(); ++face)
    for_regions(face, [&](Region_index region) { patches[region].faces.push_back(face); });
}

/// Lists in each patch the vertices of its faces, ascending. Most are in the region itself, and need no sorting.
void list_vertices(std::span<const Corners> mesh_corners, std::span<const Region_index> labels,
                   std::vector<Patch>& patches) {
  std::vector<bool> used(labels.size(), false);
  for (const auto& face : mesh_corners)
    for (const auto corner : face) used[corner] = true;
  for (std::uint32_t v = 0; v < labels.size(); ++v)
    if (used[v]) patches[labels[v]].vertices.push_back(v);

  std::vector<std::uint32_t> others;
  for (Region_index region = 0; region < patches.size(); ++region) {
    auto& [faces, vertices, corners] = patches[region];
    others.clear();
    for (const auto face : faces)
      for (const auto corner : mesh_corners[face])
        if (labels[corner] != region) others.push_back(corner);
    std::ranges::sort(others);
    others.erase(std::unique(others.begin(), others.end()), others.end());
    const auto own = static_cast<std::ptrdiff_t>(vertices.size());
    vertices.insert(vertices.end(), others.begin(), others.end());
    std::inplace_merge(vertices.begin(), vertices.begin() + own, vertices.end());
  }
}

std::uint32_t index_in(const std::vector<std::uint32_t>& vertices, std::uint32_t vertex) {
  return static_cast<std::uint32_t>(std::ranges::lower_bound(vertices, vertex) - vertices.begin());
}

/// Lists in each patch the corners of its faces.
void list_corners(std::span<const Corners> mesh_corners, std::span<const Region_index> labels,
                  std::vector<Patch>& patches) {
  std::vector<std::uint32_t> index_in_own(labels.size());  // per vertex: in the patch of its own region
  for (Region_index region = 0; region < patches.size(); ++region)
    for (std::uint32_t i = 0; i < patches[region].vertices.size(); ++i)
      if (labels[patches[region].vertices[i]] == region) index_in_own[patches[region].vertices[i]] = i;

  for (Region_index region = 0; region < patches.size(); ++region) {
    Patch& patch = patches[region];
    const auto index = [&](std::uint32_t vertex) {
      return labels[vertex] == region ? index_in_own[vertex] : index_in(patch.vertices, vertex);
    };
    patch.corners.reserve(patch.faces.size());
    for (const auto face : patch.faces) {
      const auto& [a, b, c] = mesh_corners[face];
      patch.corners.push_back({index(a), index(b), index(c)});
    }
  }
}

}  // namespace

Patch make_patch(std::vector<std::uint32_t> faces, std::span<const Corners> mesh_corners) {
  Patch patch{.faces = std::move(faces)};
  std::ranges::sort(patch.faces);
  patch.vertices.reserve(3 * patch.faces.size());
  for (const auto face : patch.faces)
    patch.vertices.insert(patch.vertices.end(), mesh_corners[face].begin(), mesh_corners[face].end());
  std::ranges::sort(patch.vertices);
  patch.vertices.erase(std::unique(patch.vertices.begin(), patch.vertices.end()), patch.vertices.end());

  patch.corners.reserve(patch.faces.size());
  for (const auto face : patch.faces) {
    const auto& [a, b, c] = mesh_corners[face];
    patch.corners.push_back({index_in(patch.vertices, a), index_in(patch.vertices, b), index_in(patch.vertices, c)});
  }
  return patch;
}

std::vector<Patch> region_patches(std::span<const Corners> mesh_corners, std::span<const Region_index> labels,
                                  std::size_t regions) {
  std::vector<Patch> patches(regions);
  list_faces(mesh_corners, labels, patches);
  list_vertices(mesh_corners, labels, patches);
  list_corners(mesh_corners, labels, patches);
  return patches;
}

}  // namespace lodestone
