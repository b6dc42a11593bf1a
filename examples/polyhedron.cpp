// SPDX-License-Identifier: GPL-3.0-or-later
// The same detector on another mesh type. The mesh keeps its region of each vertex in a property map.
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <cstdio>
#include <exception>
#include <map>

#include "lodestone/detector.h"
#include "lodestone/io/shapes/shapes.h"

using namespace lodestone;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;

Polyhedron polyhedron(const Surface_mesh& mesh) {
  Polyhedron result;
  CGAL::copy_face_graph(mesh, result);
  return result;
}

int main() try {
  Polyhedron knot = polyhedron(torus_knot());
  Polyhedron sphere = polyhedron(icosphere(10));

  Detector detector({.particles = 12, .contacts = Contact_query::all});
  const Object_id first = detector.add(knot);
  detector.add(sphere);
  bool met = false;
  for (int frame = 0; frame < 40; ++frame) {
    for (auto v = sphere.vertices_begin(); v != sphere.vertices_end(); ++v)
      v->point() = v->point() + Kernel::Vector_3(0.1, 0, 0);
    const Frame& found = detector.detect();
    met |= found.collides();
    if (frame % 10 == 0) std::printf("frame %2d: %zu pairs of faces intersect\n", frame, found.face_pairs.size());
  }

  std::map<Region_index, std::size_t> sizes;
  for (const auto v : vertices(knot)) ++sizes[get(detector.maps<Polyhedron>(first).region(), v)];
  std::printf("the knot has %zu vertices in %zu regions\n", num_vertices(knot), sizes.size());
  return met ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
