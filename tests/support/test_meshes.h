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
Surface_mesh mesh_of(const std::vector<Point>& points, const std::vector<Corners>& faces);

Surface_mesh tetrahedron();

Surface_mesh single_triangle();

/// Faces of a grid of vertices, `columns` in a row; every square is cut from its lower left to its upper right corner.
std::vector<Corners> grid_faces(std::uint32_t columns, std::uint32_t rows);

/// A flat grid: vertex y * columns + x lies at (x, y, 0).
Surface_mesh grid(std::uint32_t columns, std::uint32_t rows);

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

Surface_mesh sphere(int parts, double radius = 1, const Point& centre = {0, 0, 0});

/// A closed surface without symmetry, so that no two distances on it are equal.
Surface_mesh potato(int parts, std::uint64_t seed = 1);

/// The surface of the cube [0, 1]^3 with `parts`^2 squares a side.
Surface_mesh cube(int parts);

/// Takes every vertex p to `map(p)`.
template <class Map>
void deform(Surface_mesh& mesh, Map map) {
  for (const auto v : mesh.vertices()) mesh.point(v) = map(mesh.point(v));
}

void shift(Surface_mesh& mesh, double x, double y = 0, double z = 0);

void scale(Surface_mesh& mesh, double factor);

/// Moves every vertex at random, along the first `axes` axes.
void crumple(Surface_mesh& mesh, double distance, std::uint64_t seed, int axes = 3);

/// The point rounded to float: CGAL's wrapper of OpenMesh writes floats.
Point as_float(const Point& p);

Surface_mesh as_float(Surface_mesh mesh);

/// Adds a copy of `part` to `mesh` as separate components.
void append(Surface_mesh& mesh, const Surface_mesh& part);

/// The same faces, each with three vertices of its own: 3 f, 3 f + 1 and 3 f + 2.
Surface_mesh flat_shaded(const Surface_mesh& mesh);

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
std::vector<std::vector<std::size_t>> pieces_of(const Vertex_graph& graph, const std::vector<Region_index>& labels,
                                                std::size_t regions);

}  // namespace lodestone
