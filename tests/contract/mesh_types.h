// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh types that every stage is tested on, and one way to make any of them from points and faces.
#pragma once

#include <CGAL/Linear_cell_complex_for_bgl_combinatorial_map_helper.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/graph_traits_Linear_cell_complex_for_combinatorial_map.h>
#include <CGAL/boost/graph/graph_traits_TriMesh_ArrayKernelT.h>
#include <gtest/gtest.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <array>
#include <vector>

#include "lodestone/mesh/concepts.h"

namespace lodestone {

struct Double_traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};

using Polyhedron = CGAL::Polyhedron_3<Kernel>;
using Open_mesh = OpenMesh::TriMesh_ArrayKernelT<Double_traits>;
using Cell_complex =
    CGAL::Linear_cell_complex_for_bgl_combinatorial_map_helper<2, 3, CGAL::Linear_cell_complex_traits<3, Kernel>>::type;

using Mesh_types = ::testing::Types<Surface_mesh, Polyhedron, Open_mesh, Cell_complex>;

/// A mesh of type `Mesh` with the vertices and faces of `source`, with the same indices.
template <class Mesh>
Mesh converted(const Surface_mesh& source) {
  Mesh mesh;
  [[maybe_unused]] auto points = get(CGAL::vertex_point, mesh);
  std::vector<Vertex<Mesh>> made;
  for (const auto v : source.vertices()) {
    made.push_back(add_vertex(mesh));
    const auto& p = source.point(v);
    // CGAL's point map of OpenMesh writes floats, whatever type the mesh stores.
    if constexpr (std::is_same_v<Mesh, Open_mesh>)
      mesh.set_point(made.back(), Double_traits::Point(p.x(), p.y(), p.z()));
    else
      put(points, made.back(), p);
  }
  for (const auto f : source.faces()) {
    std::vector<Vertex<Mesh>> corners;
    for (const auto v : source.vertices_around_face(source.halfedge(f))) corners.push_back(made[v]);
    CGAL::Euler::add_face(corners, mesh);
  }
  return mesh;
}

/// A map from vertices to points, beside the mesh: its own points, moved.
template <class Mesh>
auto moved_points(const Mesh& mesh, double x, double y, double z) {
  const auto own = get(CGAL::vertex_point, mesh);
  const auto points = get(CGAL::dynamic_vertex_property_t<Point>(), mesh);
  for (const auto v : vertices(mesh)) {
    const auto p = coordinates(get(own, v));
    put(points, v, Point(p.x() + x, p.y() + y, p.z() + z));
  }
  return points;
}

}  // namespace lodestone
