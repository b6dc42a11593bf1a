// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/test_meshes.h"

namespace lodestone {

Surface_mesh mesh_of(const std::vector<Point>& points, const std::vector<Corners>& faces) {
  using Index = Surface_mesh::Vertex_index;
  Surface_mesh mesh;
  for (const auto& point : points) mesh.add_vertex(point);
  for (const auto& [a, b, c] : faces) mesh.add_face(Index(a), Index(b), Index(c));
  return mesh;
}

Surface_mesh tetrahedron() {
  return mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
}

Surface_mesh single_triangle() { return mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}); }

std::vector<Corners> grid_faces(std::uint32_t columns, std::uint32_t rows) {
  std::vector<Corners> faces;
  for (std::uint32_t y = 0; y + 1 < rows; ++y)
    for (std::uint32_t x = 0; x + 1 < columns; ++x) {
      const std::uint32_t low = y * columns + x, high = low + columns;
      faces.push_back({low, low + 1, high + 1});
      faces.push_back({low, high + 1, high});
    }
  return faces;
}

Surface_mesh grid(std::uint32_t columns, std::uint32_t rows) {
  std::vector<Point> points;
  for (std::uint32_t y = 0; y < rows; ++y)
    for (std::uint32_t x = 0; x < columns; ++x) points.emplace_back(x, y, 0);
  return mesh_of(points, grid_faces(columns, rows));
}

Surface_mesh sphere(int parts, double radius, const Point& centre) {
  return octahedral(parts, [&](const std::array<int, 3>& p) {
    const double scale = radius / std::hypot(p[0], p[1], p[2]);
    return Point(centre.x() + scale * p[0], centre.y() + scale * p[1], centre.z() + scale * p[2]);
  });
}

Surface_mesh potato(int parts, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> bump(0.9, 1.1);
  return octahedral(parts, [&](const std::array<int, 3>& p) {
    const double scale = bump(random) / std::hypot(p[0], p[1], p[2]);
    return Point(1.7 * scale * p[0], 1.2 * scale * p[1], scale * p[2]);
  });
}

Surface_mesh cube(int parts) {
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

void shift(Surface_mesh& mesh, double x, double y, double z) {
  deform(mesh, [&](const Point& p) { return Point(p.x() + x, p.y() + y, p.z() + z); });
}

void scale(Surface_mesh& mesh, double factor) {
  deform(mesh, [&](const Point& p) { return Point(factor * p.x(), factor * p.y(), factor * p.z()); });
}

void crumple(Surface_mesh& mesh, double distance, std::uint64_t seed, int axes) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> step(0, distance);
  deform(mesh, [&](const Point& p) {
    const double x = step(random), y = step(random), z = step(random);
    return Point(p.x() + x, p.y() + (axes > 1 ? y : 0), p.z() + (axes > 2 ? z : 0));
  });
}

Point as_float(const Point& p) {
  const auto rounded = [](double x) { return static_cast<double>(static_cast<float>(x)); };
  return {rounded(p.x()), rounded(p.y()), rounded(p.z())};
}

Surface_mesh as_float(Surface_mesh mesh) {
  deform(mesh, [](const Point& p) { return as_float(p); });
  return mesh;
}

void append(Surface_mesh& mesh, const Surface_mesh& part) { mesh.join(part); }

std::vector<std::vector<std::size_t>> pieces_of(const Vertex_graph& graph, const std::vector<Region_index>& labels,
                                                std::size_t regions) {
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

Surface_mesh flat_shaded(const Surface_mesh& mesh) {
  Surface_mesh apart;
  for (const auto face : faces(mesh)) {
    std::vector<Surface_mesh::Vertex_index> corners;
    for (const auto v : vertices_around_face(halfedge(face, mesh), mesh))
      corners.push_back(apart.add_vertex(mesh.point(v)));
    apart.add_face(corners);
  }
  return apart;
}

}  // namespace lodestone
