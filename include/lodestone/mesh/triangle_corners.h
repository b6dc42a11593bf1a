// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "lodestone/mesh/concepts.h"

/// The corners of a face from its halfedges. Most meshes keep both halves of an edge side by side, so what the halves
/// of one edge tell is cheaper than going on to the next edge.
namespace lodestone {

/// A mesh whose halfedges know the one before and where they begin, as all models of CGAL's HalfedgeGraph do.
template <class Mesh>
concept Linked_both_ways = requires(const Mesh& mesh, Halfedge<Mesh> h) {
  { prev(h, mesh) } -> std::convertible_to<Halfedge<Mesh>>;
  { source(h, mesh) } -> std::convertible_to<Vertex<Mesh>>;
};

/// Whether the face of a halfedge has three edges.
template <Triangle_mesh Mesh>
bool is_triangle(Halfedge<Mesh> first, const Mesh& mesh) {
  const auto third = next(next(first, mesh), mesh);
  if constexpr (Linked_both_ways<Mesh>) return third == prev(first, mesh);
  return next(third, mesh) == first;
}

/// The corners of a triangle: where a halfedge of it ends, and the two that follow around the face.
template <Triangle_mesh Mesh>
std::array<Vertex<Mesh>, 3> triangle_corners(Halfedge<Mesh> first, const Mesh& mesh) {
  const auto second = next(first, mesh);
  if constexpr (Linked_both_ways<Mesh>) return {target(first, mesh), target(second, mesh), source(first, mesh)};
  return {target(first, mesh), target(second, mesh), target(next(second, mesh), mesh)};
}

}  // namespace lodestone
