// SPDX-License-Identifier: GPL-3.0-or-later
// Checks that every partition strategy must pass on any surface.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <vector>

#include "lodestone/partition/partition.h"
#include "support/test_meshes.h"

namespace lodestone {

template <class Strategy>
std::vector<Region_index> labels_of(const Strategy& strategy, const Surface_mesh& mesh, std::size_t regions) {
  const Numbered_mesh numbered(mesh);
  return strategy.label({numbered.graph, numbered.positions, numbered.faces}, regions).labels;
}

/// Number of vertices of each label.
template <class Strategy>
std::vector<std::size_t> label_sizes(const Strategy& strategy, const Surface_mesh& mesh, std::size_t regions) {
  std::vector<std::size_t> sizes;
  for (const auto label : labels_of(strategy, mesh, regions)) {
    if (label >= sizes.size()) sizes.resize(label + 1, 0);
    ++sizes[label];
  }
  return sizes;
}

/// Every connected surface gets exactly the requested number of regions, up to one per vertex.
template <class Strategy>
void expect_exact_counts(const Strategy& strategy) {
  for (const auto& mesh : {single_triangle(), tetrahedron(), grid(9, 2), cube(3), sphere(4), potato(6)})
    for (const std::size_t wanted : {1, 2, 3, 4, 6, 11, 17, 18, 66, 1000}) {
      const std::size_t regions = std::min<std::size_t>(wanted, mesh.number_of_vertices());
      const auto sizes = label_sizes(strategy, mesh, regions);
      EXPECT_EQ(sizes.size(), regions) << mesh.number_of_vertices() << " vertices";
      EXPECT_EQ(std::ranges::count(sizes, 0U), 0);
    }
}

/// A surface as a list of faces, which need not form a mesh.
struct Face_soup {
  Positions positions;
  std::vector<Corners> faces;
  Vertex_graph graph = vertex_graph(static_cast<std::uint32_t>(positions.rows()), faces);

  Numbered_surface surface() const { return {graph, positions, faces}; }
};

/// Surfaces that break careless strategies.
inline std::vector<Face_soup> odd_surfaces() {
  std::vector<Face_soup> all;
  const auto add = [&](const Surface_mesh& mesh) {
    const Numbered_mesh numbered(mesh);
    all.push_back({numbered.positions, {numbered.faces.begin(), numbered.faces.end()}});
  };
  auto mesh = sphere(4);
  for (int i = 0; i < 10; ++i) mesh.add_vertex({100.0 + 10 * i, 0, 0});
  add(mesh);  // with isolated vertices
  mesh = sphere(4);
  deform(mesh, [](const Point& p) { return Point(p.x(), 0, 0); });
  add(mesh);  // all faces without area
  deform(mesh, [](const Point&) { return Point(3, 1, 2); });
  add(mesh);  // without extent
  mesh = sphere(4);
  deform(mesh, [](const Point& p) { return p.x() > 0.3 ? p : Point(0, 0, 0); });
  add(mesh);  // some faces without area
  mesh = Surface_mesh();
  for (int i = 0; i < 5; ++i) append(mesh, sphere(1 + i, 0.3, {1.0 * i, 0, 0}));
  add(mesh);  // components
  append(mesh, Surface_mesh(mesh));
  add(mesh);  // every face twice
  for (const double size : {1e-300, 1e-160, 1e160, 1e300}) {
    mesh = potato(4);
    scale(mesh, size);
    add(mesh);
  }
  mesh = potato(4);
  mesh.point(Surface_mesh::Vertex_index(7)) = Point(1e200, 0, 0);
  add(mesh);  // a spike that dwarfs everything else
  mesh = potato(4);
  deform(mesh, [](const Point& p) { return Point(1e9 + p.x() * 1e-9, p.y() * 1e-9, p.z() * 1e-9); });
  add(mesh);  // smaller than the spacing of doubles at its position
  mesh = potato(4);
  deform(mesh, [](const Point& p) { return Point(p.x(), p.y() * 1e-170, p.z() * 1e-200); });
  add(mesh);                                                                    // nearly, but not quite, a line
  all.push_back({Positions::Random(5, 3), {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}});  // an edge of three faces
  all.push_back({Positions::Random(5, 3), {{0, 1, 2}, {0, 3, 4}}});             // two fans at a vertex
  all.push_back({Positions::Random(4, 3), {{0, 1, 2}, {0, 1, 3}}});             // neighbours disagree
  all.push_back({Positions::Random(6, 3), {{0, 0, 1}, {1, 2, 3}, {4, 4, 4}, {4, 4, 5}}});  // corners twice
  all.push_back({Positions::Random(3, 3), {{0, 0, 1}}});                                   // and nothing else
  all.push_back({Positions::Random(3, 3), {{0, 1, 2}, {0, 1, 2}, {2, 1, 0}}});             // one face three times
  std::vector<Corners> loose;
  for (std::uint32_t i = 0; i < 40; ++i) loose.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  all.push_back({Positions::Random(120, 3), loose});  // triangles without neighbours
  return all;
}

/// On any surface, every vertex gets a label below V, the same in each run, and `partition()` makes valid regions.
template <class Strategy>
void expect_odd_surfaces_labelled(const Strategy& strategy) {
  std::size_t number = 0;
  for (const auto& soup : odd_surfaces()) {
    SCOPED_TRACE("surface " + std::to_string(number++));
    const auto vertices = static_cast<std::size_t>(soup.positions.rows());
    for (const std::size_t regions : {std::size_t{1}, std::size_t{2}, std::size_t{5}, vertices}) {
      if (regions > vertices) continue;
      const auto labelling = strategy.label(soup.surface(), regions);
      ASSERT_EQ(labelling.labels.size(), vertices);
      for (const auto label : labelling.labels) ASSERT_LT(label, vertices);
      EXPECT_EQ(strategy.label(soup.surface(), regions).labels, labelling.labels);

      const auto result = finish_partition(soup.graph, soup.positions, soup.faces, labelling, {});
      for (const auto& pieces : pieces_of(soup.graph, result.labels, result.regions)) EXPECT_LE(pieces.size(), 1U);
    }
  }
}

}  // namespace lodestone
