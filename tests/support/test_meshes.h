// SPDX-License-Identifier: GPL-3.0-or-later
// Small surfaces of known sizes, and the inputs of the stages by index.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <span>
#include <vector>

#include "lodestone/mesh/concepts.h"
#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/mesh/vertex_graph.h"

namespace lodestone {

/// A mesh with these vertices and faces, with the same indices.
inline Surface_mesh mesh_of(const std::vector<Point>& points, const std::vector<Corners>& faces) {
  using Index = Surface_mesh::Vertex_index;
  Surface_mesh mesh;
  for (const auto& point : points) mesh.add_vertex(point);
  for (const auto& [a, b, c] : faces) mesh.add_face(Index(a), Index(b), Index(c));
  return mesh;
}

inline Surface_mesh tetrahedron() {
  return mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
}

inline Surface_mesh single_triangle() { return mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}); }

/// Faces of a grid of vertices, `columns` in a row; every square is cut from its lower left to its upper right corner.
inline std::vector<Corners> grid_faces(std::uint32_t columns, std::uint32_t rows) {
  std::vector<Corners> faces;
  for (std::uint32_t y = 0; y + 1 < rows; ++y)
    for (std::uint32_t x = 0; x + 1 < columns; ++x) {
      const std::uint32_t low = y * columns + x, high = low + columns;
      faces.push_back({low, low + 1, high + 1});
      faces.push_back({low, high + 1, high});
    }
  return faces;
}

/// A flat grid: vertex y * columns + x lies at (x, y, 0).
inline Surface_mesh grid(std::uint32_t columns, std::uint32_t rows) {
  std::vector<Point> points;
  for (std::uint32_t y = 0; y < rows; ++y)
    for (std::uint32_t x = 0; x < columns; ++x) points.emplace_back(x, y, 0);
  return mesh_of(points, grid_faces(columns, rows));
}

/// A closed surface from an octahedron whose edges are cut into `parts`, 8 parts^2 faces, no vertex with more than 6
/// neighbours. `place` takes the corners of the lattice |x| + |y| + |z| = parts to points.
template <class Place>
Surface_mesh octahedral(int parts, Place place) {
  Surface_mesh mesh;
  std::map<std::array<int, 3>, Surface_mesh::Vertex_index> made;
  const auto vertex = [&](const std::array<int, 3>& key) {
    const auto [entry, fresh] = made.try_emplace(key);
    if (fresh) entry->second = mesh.add_vertex(place(key));
    return entry->second;
  };
  for (int octant = 0; octant < 8; ++octant) {
    const std::array<int, 3> sign{octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1};
    const auto at = [&](int i, int j, int k) { return vertex({sign[0] * i, sign[1] * j, sign[2] * k}); };
    const auto add = [&](auto a, auto b, auto c) {
      if (sign[0] * sign[1] * sign[2] > 0)
        mesh.add_face(a, b, c);
      else
        mesh.add_face(a, c, b);
    };
    for (int i = 0; i < parts; ++i)
      for (int j = 0; i + j < parts; ++j) {
        const int k = parts - 1 - i - j;
        add(at(i + 1, j, k), at(i, j + 1, k), at(i, j, k + 1));
        if (k > 0) add(at(i, j + 1, k), at(i + 1, j, k), at(i + 1, j + 1, k - 1));
      }
  }
  return mesh;
}

inline Surface_mesh sphere(int parts, double radius = 1, const Point& centre = {0, 0, 0}) {
  return octahedral(parts, [&](const std::array<int, 3>& p) {
    const double scale = radius / std::hypot(p[0], p[1], p[2]);
    return Point(centre.x() + scale * p[0], centre.y() + scale * p[1], centre.z() + scale * p[2]);
  });
}

/// A closed surface without symmetry, so that no two distances on it are equal.
inline Surface_mesh potato(int parts, std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> bump(0.9, 1.1);
  return octahedral(parts, [&](const std::array<int, 3>& p) {
    const double scale = bump(random) / std::hypot(p[0], p[1], p[2]);
    return Point(1.7 * scale * p[0], 1.2 * scale * p[1], scale * p[2]);
  });
}

/// The surface of the cube [0, 1]^3 with `parts`^2 squares a side.
inline Surface_mesh cube(int parts) {
  Surface_mesh mesh;
  std::map<std::array<int, 3>, Surface_mesh::Vertex_index> made;
  const auto vertex = [&](const std::array<int, 3>& key) {
    const auto [entry, fresh] = made.try_emplace(key);
    const double n = parts;
    if (fresh) entry->second = mesh.add_vertex({key[0] / n, key[1] / n, key[2] / n});
    return entry->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const int level : {0, parts})
      for (int i = 0; i < parts; ++i)
        for (int j = 0; j < parts; ++j) {
          const auto at = [&](int u, int v) {
            std::array<int, 3> key{};
            key[axis] = level;
            key[(axis + 1) % 3] = level == 0 ? v : u;
            key[(axis + 2) % 3] = level == 0 ? u : v;
            return vertex(key);
          };
          mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
          mesh.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
  return mesh;
}

/// Takes every vertex p to `map(p)`.
template <class Map>
void deform(Surface_mesh& mesh, Map map) {
  for (const auto v : mesh.vertices()) mesh.point(v) = map(mesh.point(v));
}

inline void shift(Surface_mesh& mesh, double x, double y = 0, double z = 0) {
  deform(mesh, [&](const Point& p) { return Point(p.x() + x, p.y() + y, p.z() + z); });
}

inline void scale(Surface_mesh& mesh, double factor) {
  deform(mesh, [&](const Point& p) { return Point(factor * p.x(), factor * p.y(), factor * p.z()); });
}

/// The point rounded to float: CGAL's wrapper of OpenMesh writes floats.
inline Point as_float(const Point& p) {
  const auto rounded = [](double x) { return static_cast<double>(static_cast<float>(x)); };
  return {rounded(p.x()), rounded(p.y()), rounded(p.z())};
}

inline Surface_mesh as_float(Surface_mesh mesh) {
  deform(mesh, [](const Point& p) { return as_float(p); });
  return mesh;
}

/// Adds a copy of `part` to `mesh` as separate components.
inline void append(Surface_mesh& mesh, const Surface_mesh& part) { mesh.join(part); }

/// A mesh by index, as the stages take it.
struct Numbered_mesh {
  Mesh_numbering<Surface_mesh> numbering;
  Vertex_graph graph;
  Positions positions;
  std::span<const Corners> faces;

  explicit Numbered_mesh(const Surface_mesh& mesh)
      : numbering(mesh),
        graph(vertex_graph(numbering.vertex_count(), numbering.corners())),
        positions(read_positions(numbering, mesh.points())),
        faces(numbering.corners()) {}

  std::span<const double> coordinates() const { return {positions.data(), static_cast<std::size_t>(positions.size())}; }
};

/// Sizes of the connected pieces of each label, by flood fill; skips vertices without edges.
inline std::vector<std::vector<std::size_t>> pieces_of(const Vertex_graph& graph,
                                                       const std::vector<Region_index>& labels, std::size_t regions) {
  std::vector<std::vector<std::size_t>> pieces(regions);
  std::vector<bool> seen(labels.size(), false);
  for (std::uint32_t start = 0; start < labels.size(); ++start) {
    if (seen[start] || neighbours(graph, start).empty()) continue;
    std::vector<std::uint32_t> flood{start};
    seen[start] = true;
    for (std::size_t i = 0; i < flood.size(); ++i)
      for (const std::uint32_t w : neighbours(graph, flood[i]))
        if (!seen[w] && labels[w] == labels[start]) {
          seen[w] = true;
          flood.push_back(w);
        }
    pieces.at(labels[start]).push_back(flood.size());
  }
  return pieces;
}

}  // namespace lodestone
