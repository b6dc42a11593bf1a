// SPDX-License-Identifier: GPL-3.0-or-later
// One call for two meshes; then a detector that follows them while one moves through the other.
#include <cstdio>
#include <exception>

#include "lodestone/find_collisions.h"
#include "lodestone/io/shapes/shapes.h"

using namespace lodestone;

int main() try {
  Surface_mesh knot = torus_knot();
  Surface_mesh sphere = icosphere(12);

  const Collisions now = find_collisions(knot, sphere, {.particles = 32, .contacts = Contact_query::all});
  std::printf("at rest: %zu pairs of faces intersect\n", now.faces.size());

  Detector<Surface_mesh> detector({.particles = 32, .contacts = Contact_query::first});
  detector.add(knot);
  const Object_id moving = detector.add(sphere);
  for (int frame = 0; frame < 60; ++frame) {
    for (const auto v : sphere.vertices()) sphere.point(v) = sphere.point(v) + Kernel::Vector_3(0.05, 0, 0.02);
    detector.update(moving);
    for (const auto& pair : detector.detect().pairs)
      if (!pair.collides) {
        std::printf("apart from frame %d on\n", frame);
        return 0;
      }
  }
  return 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
