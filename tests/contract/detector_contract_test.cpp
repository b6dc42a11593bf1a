// SPDX-License-Identifier: GPL-3.0-or-later
// The particle and contact stages on every mesh type, in every mode.
#include <algorithm>

#include "contract/mesh_types.h"
#include "lodestone/find_collisions.h"
#include "lodestone/queries/exhaustive.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

constexpr std::array modes{Mode::particles, Mode::senin};

/// Moves every vertex of a mesh of any type.
template <class Mesh, class Map>
void deform_any(Mesh& mesh, Map map) {
  auto points = get(CGAL::vertex_point, mesh);
  for (const auto v : vertices(mesh)) {
    const auto p = coordinates(get(points, v));
    put(points, v, map(Point(p.x(), p.y(), p.z())));
  }
}

Point left(const Point& p) { return as_float(Point(p.x() - 0.0625, p.y() + 0.015625, p.z())); }
Point larger(const Point& p) { return {1.25 * p.x(), 1.25 * p.y(), 1.25 * p.z()}; }

Surface_mesh shifted_sphere() { return as_float(sphere(8, 1, {2.25, 0.125, 0.25})); }

template <class Mesh>
struct Mode_contract : ::testing::Test {};
TYPED_TEST_SUITE(Mode_contract, Mesh_types);

TYPED_TEST(Mode_contract, reports_the_same_face_pairs_as_exhaustive_checking) {
  const auto a = as_float(potato(5));
  auto b = potato(4, 2);
  shift(b, 1.5, 0.25);
  b = as_float(b);
  const auto expected = exhaustive_face_pairs(a, b);
  ASSERT_FALSE(expected.empty());
  EXPECT_EQ(exhaustive_face_pairs(converted<TypeParam>(a), converted<TypeParam>(b)), expected);
  EXPECT_EQ(exhaustive_face_pairs(a, converted<TypeParam>(b)), expected);
}

TYPED_TEST(Mode_contract, frames_equal_those_on_a_surface_mesh_and_report_only_true_contacts) {
  for (const auto mode : modes) {
    auto source_a = as_float(sphere(8)), source_b = shifted_sphere();
    auto a = converted<TypeParam>(source_a), b = converted<TypeParam>(source_b);
    const Detector_options options{.mode = mode, .particles = 24, .contacts = Contact_query::all};
    Detector<> expected(options);
    Detector<> detector(options);
    expected.add(source_a), expected.add(source_b);
    detector.add(a), detector.add(b);
    std::size_t contacts = 0;
    for (int number = 0; number < 10; ++number) {
      const Frame& frame = detector.detect();
      EXPECT_EQ(frame.face_pairs, expected.detect().face_pairs);
      EXPECT_TRUE(std::ranges::includes(exhaustive_face_pairs(a, b), frame.face_pairs));
      for (const Object_id object : {0U, 1U})
        EXPECT_EQ(detector.object(object).particles().at, expected.object(object).particles().at);
      contacts += frame.face_pairs.size();
      deform(source_b, left);
      deform_any(b, left);
      expected.update();
      detector.update();
    }
    EXPECT_GT(contacts, 0U);
  }
}

TYPED_TEST(Mode_contract, regions_and_particles_are_in_the_maps_of_the_mesh) {
  auto a = converted<TypeParam>(sphere(6)), b = converted<TypeParam>(shifted_sphere());
  const Mesh_numbering<TypeParam> numbering(a);
  Detector<> detector({.mode = Mode::particles, .particles = 12});
  detector.add(a), detector.add(b);
  for (int frame = 0; frame < 3; ++frame) {
    detector.detect();
    const auto& maps = detector.maps<TypeParam>(0);
    const auto& surface = detector.object(0);
    for (const auto v : vertices(a)) {
      const auto index = numbering.index(v);
      EXPECT_EQ(get(maps.region(), v), surface.labels()[index]);
      const auto& at = surface.particles().at;
      const bool here = std::ranges::find(at, index) != at.end();
      EXPECT_EQ(get(maps.particle(), v), here ? surface.labels()[index] : no_particle);
    }
    deform_any(b, left);
    detector.update();
  }
}

TYPED_TEST(Mode_contract, an_object_that_grows_is_repartitioned) {
  auto a = converted<TypeParam>(sphere(6)), b = converted<TypeParam>(sphere(6, 1, {9, 0, 0}));
  Detector<> detector({.mode = Mode::particles, .least_particles = 1});
  detector.add(a), detector.add(b);
  detector.detect();
  EXPECT_EQ(detector.object(0).particles().at.size(), 2U);
  deform_any(a, larger);
  deform_any(a, larger);
  detector.update();
  EXPECT_EQ(detector.detect().statistics.repartitions, 1U);
  EXPECT_EQ(detector.object(0).particles().at.size(), 25U);  // 2 / (1 - cos(asin(1 / 2.5625))) = 25.24
}

TYPED_TEST(Mode_contract, find_collisions_gives_the_same_faces) {
  const auto a = as_float(sphere(8));
  auto b = shifted_sphere();
  shift(b, -0.5);
  b = as_float(b);
  const Detector_options options{.mode = Mode::particles, .particles = 24, .contacts = Contact_query::all};
  const auto expected = find_collisions(a, b, options);
  const auto collisions = find_collisions(converted<TypeParam>(a), converted<TypeParam>(b), options);
  EXPECT_TRUE(collisions.collides);
  EXPECT_EQ(collisions.faces, expected.faces);
}

TYPED_TEST(Mode_contract, a_detector_takes_meshes_of_two_types) {
  for (const auto mode : {Mode::particles, Mode::senin, Mode::exact}) {
    auto a = as_float(sphere(8)), source = shifted_sphere();
    auto b = converted<TypeParam>(source);
    Detector<> expected({.mode = mode, .particles = 24});
    Detector<> detector({.mode = mode, .particles = 24});
    expected.add(a), expected.add(source);
    detector.add(a), detector.add(b);
    std::size_t contacts = 0;
    for (int frame = 0; frame < 10; ++frame) {
      const Frame& found = detector.detect();
      EXPECT_EQ(found.face_pairs, expected.detect().face_pairs);
      contacts += found.face_pairs.size();
      deform(source, left);
      deform_any(b, left);
      expected.update();
      detector.update();
    }
    EXPECT_GT(contacts, 0U);
    EXPECT_NO_THROW(detector.maps<Surface_mesh>(0));
    EXPECT_NO_THROW(detector.maps<TypeParam>(1));
    if constexpr (!std::is_same_v<TypeParam, Surface_mesh>) {
      EXPECT_THROW(detector.maps<Surface_mesh>(1), Bad_argument);
    }
  }
}

TYPED_TEST(Mode_contract, find_collisions_takes_meshes_of_two_types) {
  const auto a = as_float(sphere(8));
  auto b = shifted_sphere();
  shift(b, -0.5);
  b = as_float(b);
  const auto collisions = find_collisions(a, converted<TypeParam>(b));
  EXPECT_EQ(collisions.faces, exhaustive_face_pairs(a, b));
  EXPECT_TRUE(collisions.collides);
}

TYPED_TEST(Mode_contract, bad_meshes_are_refused) {
  TypeParam empty;
  for (const auto mode : modes) {
    Detector<> detector({.mode = mode});
    EXPECT_THROW(detector.add(empty), Bad_mesh);
  }
}

}  // namespace
}  // namespace lodestone
