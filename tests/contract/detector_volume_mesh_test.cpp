// SPDX-License-Identifier: GPL-3.0-or-later
// Trees of custom volumes over a mesh type other than Surface_mesh.
#include "contract/mesh_types.h"
#include "contract/volume_models.h"
#include "lodestone/io/shapes/shapes.h"
#include "support/exact_truth.h"

namespace lodestone {
namespace {

template <class Volume>
struct Detector_volume_mesh : ::testing::Test {};
TYPED_TEST_SUITE(Detector_volume_mesh, Volume_types, Volume_names);

TYPED_TEST(Detector_volume_mesh, a_polyhedron_gives_the_pairs_of_exhaustive_checking) {
  const auto source = potato(5);
  auto moving = torus_knot({.radius = 0.7, .tube = 0.1, .segments = 40, .sides = 5});
  const auto a = converted<Polyhedron>(source);
  auto b = converted<Polyhedron>(moving);
  Volume_detector<TypeParam> detector({.mode = Mode::exact, .tree = {.leaf_faces = 8}});
  detector.add(a), detector.add(std::as_const(b));
  std::size_t colliding = 0;
  for (int frame = 0; frame < 4; ++frame) {
    colliding += expect_exhaustive(detector.detect(), {&source, &moving});
    deform(moving, [&](const Point& p) { return Point(p.x() + 0.3, p.y() + 0.1 * std::sin(3 * p.z()), p.z()); });
    auto position = moving.points().begin();
    for (const auto v : vertices(b)) v->point() = *position++;
  }
  EXPECT_GT(colliding, 1U);
}

}  // namespace
}  // namespace lodestone
