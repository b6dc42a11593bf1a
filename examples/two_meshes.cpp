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

  const Collisions now = find_collisions(knot, sphere);
  std::printf("at rest: %zu pairs of faces intersect\n", now.faces.size());

  Detector detector({.contacts = Contact_query::yes_no});
  detector.add(knot);
  detector.add(sphere);
  for (int frame = 0; frame < 60; ++frame) {
    for (const auto v : sphere.vertices()) sphere.point(v) = sphere.point(v) + Kernel::Vector_3(0.1, 0, 0.04);
    if (detector.detect().collides()) continue;
    std::printf("apart from frame %d on\n", frame);
    return 0;
  }
  return 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
