// SPDX-License-Identifier: GPL-3.0-or-later
#include "partition/strategy_cases.h"

namespace lodestone {

std::size_t different(const std::vector<Region_index>& labels) {
  return std::set<Region_index>(labels.begin(), labels.end()).size();
}

std::vector<std::size_t> sizes_of(const std::vector<Region_index>& labels) {
  std::vector<std::size_t> sizes;
  for (const auto label : labels) {
    if (label >= sizes.size()) sizes.resize(label + 1, 0);
    ++sizes[label];
  }
  return sizes;
}

Surface_mesh scattered_mesh() {
  auto mesh = sphere(3, 1, {0, 0, 0});
  auto sheet = grid(4, 5);
  shift(sheet, 0, 0, 5);
  append(mesh, sheet);
  append(mesh, sheet);
  append(mesh, sphere(1, 0.1, {9, 0, 0}));
  for (int i = 0; i < 4; ++i) mesh.add_vertex({-3.0 - i, 1, 0});
  return mesh;
}

std::vector<std::pair<Surface_mesh, std::size_t>> awkward_meshes() {
  auto flat = grid(7, 6);
  auto line = grid(5, 5);
  deform(line, [](const Point& p) { return Point(p.x() + 5 * p.y(), 0, 0); });
  auto point = sphere(2);
  deform(point, [](const Point&) { return Point(3, 1, 2); });
  auto huge = potato(3), tiny = potato(3);
  scale(huge, 1e150);
  scale(tiny, 1e-150);
  return {{single_triangle(), 3}, {tetrahedron(), 4}, {flat, 42}, {line, 25}, {point, 1}, {huge, 38}, {tiny, 38},
          {scattered_mesh(), 64}};
}

}  // namespace lodestone
