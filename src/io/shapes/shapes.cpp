// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/shapes/shapes.h"

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "io/shapes/directions.h"
#include "io/shapes/shape_checks.h"

namespace lodestone {

namespace {

using Vector = Kernel::Vector_3;
using Vertices = std::vector<Surface_mesh::Vertex_index>;

using detail::turn;
using detail::unit;

void add_square(Surface_mesh& mesh, Surface_mesh::Vertex_index a, Surface_mesh::Vertex_index b,
                Surface_mesh::Vertex_index c, Surface_mesh::Vertex_index d) {
  mesh.add_face(a, b, c);
  mesh.add_face(a, c, d);
}

Point on_unit_sphere(double polar, double azimuth) {
  return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)};
}

Vertices add_circle_of_latitude(Surface_mesh& mesh, double polar, std::size_t slices) {
  Vertices circle;
  for (std::size_t i = 0; i < slices; ++i)
    circle.push_back(mesh.add_vertex(on_unit_sphere(polar, turn * double(i) / double(slices))));
  return circle;
}

/// Joins two rings of vertices by a band of squares. Seen from outside, `upper` is above `lower`, and both run from
/// left to right.
void add_band(Surface_mesh& mesh, const Vertices& upper, const Vertices& lower) {
  for (std::size_t i = 0; i < upper.size(); ++i) {
    const std::size_t j = (i + 1) % upper.size();
    add_square(mesh, upper[i], lower[i], lower[j], upper[j]);
  }
}

}  // namespace

Surface_mesh uv_sphere(std::size_t slices, std::size_t stacks) {
  detail::check_count("uv_sphere", "slices", slices, 3);
  detail::check_count("uv_sphere", "stacks", stacks, 2);
  detail::check_faces("uv_sphere", 2, slices, stacks);
  Surface_mesh mesh;
  std::vector<Vertices> circles;
  for (std::size_t i = 1; i < stacks; ++i)
    circles.push_back(add_circle_of_latitude(mesh, std::numbers::pi * double(i) / double(stacks), slices));
  const auto north = mesh.add_vertex(Point(0, 0, 1));
  const auto south = mesh.add_vertex(Point(0, 0, -1));

  for (std::size_t i = 0; i < slices; ++i) mesh.add_face(north, circles.front()[i], circles.front()[(i + 1) % slices]);
  for (std::size_t i = 1; i < circles.size(); ++i) add_band(mesh, circles[i - 1], circles[i]);
  for (std::size_t i = 0; i < slices; ++i) mesh.add_face(south, circles.back()[(i + 1) % slices], circles.back()[i]);
  return mesh;
}

namespace {

struct Icosahedron {
  std::array<Point, 12> corners;
  std::array<std::array<std::size_t, 3>, 20> faces;
};

/// A pole, two rings of five corners that are rotated against each other by 36 degrees, and the other pole.
Icosahedron icosahedron() {
  const double polar = std::atan(2.0);
  Icosahedron solid{};
  solid.corners[0] = Point(0, 0, 1);
  solid.corners[11] = Point(0, 0, -1);
  for (std::size_t i = 0; i < 5; ++i) {
    const std::size_t j = (i + 1) % 5;
    solid.corners[1 + i] = on_unit_sphere(polar, turn * double(i) / 5);
    solid.corners[6 + i] = on_unit_sphere(std::numbers::pi - polar, turn * (double(i) + 0.5) / 5);
    solid.faces[4 * i] = {0, 1 + i, 1 + j};
    solid.faces[4 * i + 1] = {1 + i, 6 + i, 1 + j};
    solid.faces[4 * i + 2] = {6 + i, 6 + j, 1 + j};
    solid.faces[4 * i + 3] = {11, 6 + j, 6 + i};
  }
  return solid;
}

/// The triangle's point with integer weights. Faces on both sides of an edge get the same bits: the third weight is 0,
/// and the sum of two products does not depend on their order.
Point weighted(const std::array<Point, 3>& corners, std::size_t i, std::size_t j, std::size_t k) {
  const auto coordinate = [&](int axis) {
    return double(i) * corners[0][axis] + double(j) * corners[1][axis] + double(k) * corners[2][axis];
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

void cut_face(const std::array<Point, 3>& corners, std::size_t frequency, detail::Welded_points& points,
              std::vector<detail::Triangle_numbers>& triangles) {
  const auto number = [&](std::size_t j, std::size_t k) {
    return points.number(weighted(corners, frequency - j - k, j, k));
  };
  for (std::size_t k = 0; k < frequency; ++k)
    for (std::size_t j = 0; j + k < frequency; ++j) {
      triangles.push_back({number(j, k), number(j + 1, k), number(j, k + 1)});
      if (j + k + 1 < frequency) triangles.push_back({number(j + 1, k), number(j + 1, k + 1), number(j, k + 1)});
    }
}

}  // namespace

Surface_mesh icosphere(std::size_t frequency) {
  detail::check_count("icosphere", "frequency", frequency, 1);
  detail::check_faces("icosphere", 20, frequency, frequency);
  const Icosahedron solid = icosahedron();
  detail::Welded_points points;
  std::vector<detail::Triangle_numbers> triangles;
  for (const auto& [a, b, c] : solid.faces)
    cut_face({solid.corners[a], solid.corners[b], solid.corners[c]}, frequency, points, triangles);

  Surface_mesh mesh;
  Vertices vertices;
  for (const Point& p : points.points()) vertices.push_back(mesh.add_vertex(CGAL::ORIGIN + unit(p - CGAL::ORIGIN)));
  for (const auto& [a, b, c] : triangles) mesh.add_face(vertices[a], vertices[b], vertices[c]);
  return mesh;
}

namespace {

void check(const Torus_knot_options& options) {
  detail::check_count("torus_knot", "p", options.p, 1);
  detail::check_count("torus_knot", "segments", options.segments, 3);
  detail::check_count("torus_knot", "sides", options.sides, 3);
  detail::check_faces("torus_knot", 2, options.segments, options.sides);
  detail::check_length("torus_knot", "radius", options.radius);
  detail::check_length("torus_knot", "tube", options.tube);
  if (std::gcd(options.p, options.q) != 1)
    throw Bad_argument(fmt::format("torus_knot: p = {} and q = {} have a common divisor", options.p, options.q));
}

/// Adds the circle around the knot at `t` in [0, 1). The knot lies on a torus, whose normal is perpendicular to the
/// knot's tangent. Frames built on that normal close after one round without a twist to correct.
Vertices add_cross_section(Surface_mesh& mesh, const Torus_knot_options& options, double t) {
  const double p = double(options.p);
  const double q = double(options.q);
  const double ring = options.radius / 2;
  const double around = turn * p * t;
  const double across = turn * q * t;
  const Vector outward(std::cos(around), std::sin(around), 0);
  const Vector forward(-std::sin(around), std::cos(around), 0);
  const Vector up(0, 0, 1);

  const Vector normal = std::cos(across) * outward + std::sin(across) * up;
  const Vector along_ring = -std::sin(across) * outward + std::cos(across) * up;
  const Point middle = CGAL::ORIGIN + options.radius * outward + ring * normal;
  const Vector tangent = unit(p * (options.radius + ring * std::cos(across)) * forward + q * ring * along_ring);
  const Vector binormal = CGAL::cross_product(tangent, normal);

  Vertices circle;
  for (std::size_t i = 0; i < options.sides; ++i) {
    const double angle = turn * double(i) / double(options.sides);
    circle.push_back(mesh.add_vertex(middle + options.tube * (std::cos(angle) * normal + std::sin(angle) * binormal)));
  }
  return circle;
}

}  // namespace

Surface_mesh torus_knot(const Torus_knot_options& options) {
  check(options);
  Surface_mesh mesh;
  std::vector<Vertices> circles;
  for (std::size_t i = 0; i < options.segments; ++i)
    circles.push_back(add_cross_section(mesh, options, double(i) / double(options.segments)));
  for (std::size_t i = 0; i < circles.size(); ++i) add_band(mesh, circles[(i + 1) % circles.size()], circles[i]);
  return mesh;
}

Surface_mesh cloth(std::size_t columns, std::size_t rows) {
  detail::check_count("cloth", "columns", columns, 1);
  detail::check_count("cloth", "rows", rows, 1);
  detail::check_faces("cloth", 2, columns, rows);
  Surface_mesh mesh;
  Vertices grid;
  for (std::size_t j = 0; j <= rows; ++j)
    for (std::size_t i = 0; i <= columns; ++i)
      grid.push_back(mesh.add_vertex(Point(double(i) / double(columns), double(j) / double(rows), 0)));
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i) {
      const std::size_t corner = j * (columns + 1) + i;
      add_square(mesh, grid[corner], grid[corner + 1], grid[corner + columns + 2], grid[corner + columns + 1]);
    }
  return mesh;
}

}  // namespace lodestone
