// SPDX-License-Identifier: GPL-3.0-or-later
// Mode exact on two spheres, one of which sinks into the other: all contacts of a frame, the distance before they
// touch, and a walk over the two trees with a custom visitor.
#include <cstdio>
#include <exception>

#include "lodestone/detector.h"
#include "lodestone/io/shapes/shapes.h"

using namespace lodestone;

namespace {

/// Counts contacts and stops at a limit.
struct Counter {
  std::size_t limit;
  std::size_t count = 0;
  Visit operator()(Face_pair) { return ++count < limit ? Visit::go_on : Visit::stop; }
};

}  // namespace

int main() try {
  const Surface_mesh below = icosphere(20);
  Surface_mesh above = below;
  Detector detector({.mode = Mode::exact, .contact_normals = true});
  const auto a = detector.add(above), b = detector.add(below);

  for (const double height : {2.5, 1.9, 1.0}) {
    for (const auto v : above.vertices()) above.point(v) = below.point(v) + Kernel::Vector_3(0, 0, height);
    const Frame& frame = detector.detect();  // reads the current positions
    if (frame.collides())
      std::printf("height %.1f: %zu contacts, the first along z = %.2f\n", height, frame.face_pairs.size(),
                  frame.contact_normals[0].normal.z());
    else
      std::printf("height %.1f: %.3f apart\n", height, detector.closest(a, b).points.distance);
  }

  Counter counter{.limit = 10};
  detector.visit(a, b, counter);
  std::printf("stopped after %zu contacts\n", counter.count);
  return counter.count == 10 ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
