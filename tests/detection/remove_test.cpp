// SPDX-License-Identifier: GPL-3.0-or-later
// What remains when an object is removed, in every mode.
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>

#include "detection/detector_scenes.h"

namespace lodestone {
namespace {

using Id_pairs = std::vector<std::pair<Object_id, Object_id>>;

class Removal_in_mode : public testing::TestWithParam<Mode> {
 protected:
  Detector<> detector{{.mode = GetParam(), .particles = 32}};
  /// Each of these spheres meets its neighbours, and no other.
  Owned_meshes scene{sphere(8), sphere(8, 1, {1.8, 0.1, 0}), sphere(8, 1, {3.6, 0, 0.1}),
                     sphere(8, 1, {5.4, 0.1, 0.1})};

  Id_pairs colliding() {
    Id_pairs pairs;
    const Frame& frame = detector.detect();
    expect_true(frame, scene);
    for (const auto& pair : frame.pairs)
      if (pair.collides) pairs.emplace_back(pair.a, pair.b);
    return pairs;
  }
};

INSTANTIATE_TEST_SUITE_P(modes, Removal_in_mode, testing::Values(Mode::particles, Mode::senin, Mode::exact),
                         [](const auto& tested) { return std::string(name_of(tested.param)); });

TEST_P(Removal_in_mode, leaves_the_ids_of_the_others_as_they_are) {
  add_all(detector, scene);
  colliding();
  detector.remove(1);
  const Id_pairs found = colliding();
  if (GetParam() == Mode::exact) {
    EXPECT_EQ(found, (Id_pairs{{2, 3}}));
  }
  for (const auto& pair : found) EXPECT_EQ(pair, std::pair(Object_id{2}, Object_id{3}));
  EXPECT_EQ(detector.size(), 4U);
  EXPECT_FALSE(detector.has(1));
  for (const Object_id other : {0U, 2U, 3U}) EXPECT_TRUE(detector.has(other));
}

TEST_P(Removal_in_mode, lets_the_others_go_on) {
  add_all(detector, scene);
  detector.remove(0);
  std::size_t found = 0;
  for (int frame = 0; frame < 10; ++frame) {
    found += colliding().size();
    shift(scene[3], -0.1);
    detector.update();
  }
  EXPECT_GT(found, 0U);
}

TEST_P(Removal_in_mode, gives_the_id_to_no_other_object) {
  add_all(detector, scene);
  detector.detect();
  detector.remove(3);
  auto another = sphere(8, 1, {3.4, 0.1, 0});
  EXPECT_EQ(detector.add(another), 4U);
  scene.push_back(another);
  for (const auto& [a, b] : colliding()) {
    EXPECT_NE(a, 3U);
    EXPECT_NE(b, 3U);
  }
}

TEST_P(Removal_in_mode, lets_go_of_the_mesh) {
  auto mesh = std::make_unique<Surface_mesh>(sphere(8, 1, {1, 0, 0}));
  detector.add(scene[0]);
  const Object_id object = detector.add(*mesh);
  detector.detect();
  detector.remove(object);
  EXPECT_TRUE((mesh->property_map<Surface_mesh::Vertex_index, Region_index>("v:region").second));
  mesh->clear();
  mesh.reset();
  detector.update();
  EXPECT_FALSE(detector.detect().collides());
}

TEST_P(Removal_in_mode, before_the_first_frame_leaves_nothing_to_build) {
  add_all(detector, scene);
  for (const Object_id object : {0U, 2U, 3U}) detector.remove(object);
  EXPECT_EQ(detector.detect().statistics.builds, 1U);
  detector.remove(1);
  EXPECT_TRUE(detector.detect().pairs.empty());
}

TEST_P(Removal_in_mode, allows_the_mesh_to_be_added_again) {
  add_all(detector, scene);
  colliding();
  detector.remove(0);
  EXPECT_EQ(detector.add(scene[0]), 4U);
  scene.push_back(scene[0]);
  const Frame& frame = detector.detect();
  for (const auto& pair : frame.pairs) EXPECT_NE(pair.a, 0U);
  if (GetParam() == Mode::exact) {
    EXPECT_EQ(colliding(), (Id_pairs{{1, 2}, {1, 4}, {2, 3}}));
  }
}

TEST_P(Removal_in_mode, makes_the_id_an_error_that_says_so) {
  add_all(detector, scene);
  detector.remove(2);
  const auto expect_refused = [](const auto& call) {
    try {
      call();
      ADD_FAILURE() << "a removed object was taken";
    } catch (const Bad_argument& error) {
      EXPECT_EQ(std::string(error.what()), "object 2 has been removed");
    }
  };
  expect_refused([&] { detector.remove(2); });
  expect_refused([&] { detector.update(2); });
  expect_refused([&] { detector.rebuild(2); });
  expect_refused([&] { detector.ignore(0, 2); });
  expect_refused([&] { detector.maps(2); });
  expect_refused([&] { detector.detect(2, 0); });
  expect_refused([&] { detector.closest(0, 2); });
  expect_refused([&] { detector.contains(2, 2); });
  expect_refused([&] { detector.tree(2); });
  expect_refused([&] { detector.object(2); });
  EXPECT_THROW(detector.remove(4), Bad_argument);
  EXPECT_NO_THROW(detector.detect());
}

TEST_P(Removal_in_mode, ends_what_was_ignored_of_the_object_alone) {
  add_all(detector, scene);
  detector.ignore(0, 1);
  detector.ignore(2, 3);
  detector.remove(0);
  for (const auto& [a, b] : colliding()) EXPECT_TRUE(a == 1 && b == 2);
}

TEST(Removal, is_refused_to_a_visitor) {
  auto scene = two_spheres(1.5);
  Detector<> detector({.mode = Mode::exact});
  add_all(detector, scene);
  const auto remove = [&](Face_pair) {
    detector.remove(0);
    return Visit::go_on;
  };
  EXPECT_THROW(detector.visit(0, 1, remove), Bad_argument);
  EXPECT_TRUE(detector.has(0));
  EXPECT_TRUE(detector.detect().collides());
}

TEST(Removal, leaves_nothing_near_however_large_the_tolerance) {
  auto scene = two_spheres(5);
  auto third = sphere(4, 1, {0, 9, 0});
  Detector<> detector({.mode = Mode::exact,
                       .contacts = Contact_query::yes_no,
                       .exact = {.tolerance = std::numeric_limits<double>::max()}});
  add_all(detector, scene);
  detector.add(third);
  EXPECT_EQ(detector.detect().pairs.size(), 3U);
  detector.remove(1);
  const Frame& frame = detector.detect();
  ASSERT_EQ(frame.pairs.size(), 1U);
  EXPECT_EQ(frame.pairs[0].b, 2U);
  EXPECT_TRUE(frame.near());
}

TEST(Removal, in_self_collision_leaves_the_object_out) {
  auto folded = sphere(8), other = sphere(8, 1, {5, 0, 0});
  crumple(folded, 0.15, 1);
  Detector<> detector({.mode = Mode::exact, .exact = {.self_collision = true}});
  detector.add(other);
  detector.add(folded);
  EXPECT_TRUE(detector.detect().collides());
  detector.remove(1);
  const Frame& frame = detector.detect();
  ASSERT_EQ(frame.pairs.size(), 1U);
  EXPECT_FALSE(frame.collides());
}

TEST(Removal, of_an_object_that_was_never_detected_leaves_no_place_without_room) {
  for (const auto& options : {Detector_options{.mode = Mode::particles, .particles = 4, .meetings = 0},
                              Detector_options{.mode = Mode::particles, .particles = 4},
                              Detector_options{.mode = Mode::senin, .particles = 4}, Detector_options{}}) {
    auto scene = two_spheres(1);
    Detector<> detector(options);
    add_all(detector, scene);
    detector.detect();
    std::deque<Surface_mesh> later(40, sphere(4, 1, {9, 0, 0}));
    for (const auto& mesh : later) detector.remove(detector.add(mesh));
    const Frame& frame = detector.detect();
    ASSERT_EQ(frame.pairs.size(), 1U);
    EXPECT_EQ(frame.pairs[0].b, 1U);
  }
}

}  // namespace
}  // namespace lodestone
