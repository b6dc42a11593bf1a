// SPDX-License-Identifier: GPL-3.0-or-later
// What the soaks count as wrong: a run without differences says nothing unless these find them.
#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "certified_soak/bound_check.h"
#include "certified_soak/two_detectors.h"
#include "lodestone/bounds/box_promise.h"
#include "lodestone/io/shapes/shapes.h"
#include "lodestone/mesh/morphed_points.h"
#include "soak/soak.h"

namespace lodestone {
namespace {

const std::vector<Face_pair> true_pairs{{0, 4}, {1, 2}, {7, 3}};

TEST(Soak, counts_face_pairs_that_one_side_lacks_or_has_twice) {
  EXPECT_EQ(count_differences(true_pairs, true_pairs), 0U);
  EXPECT_EQ(count_differences(true_pairs, {}), 3U);
  EXPECT_EQ(count_differences({}, true_pairs), 3U);
  EXPECT_EQ(count_differences(true_pairs, std::vector<Face_pair>{{0, 4}, {1, 2}, {7, 4}}), 2U);
  EXPECT_EQ(count_differences(true_pairs, std::vector<Face_pair>{{0, 4}, {1, 2}, {1, 2}, {7, 3}}), 1U);
}

/// A frame about objects 1 and 2.
Frame frame_with(Pair_result result, const std::vector<Face_pair>& contacts) {
  Frame frame;
  frame.face_pairs = contacts;
  result.a = 1, result.b = 2, result.contacts = contacts.size();
  frame.pairs = {result};
  return frame;
}

const Frame true_frame = frame_with({.collides = true}, true_pairs);

bool is_right_answer(const Pair_result& result, const std::vector<Face_pair>& contacts,
                     const Detector_options& asked = {.contacts = Contact_query::all}) {
  return is_right(frame_with(result, contacts), true_frame, {1, 2}, asked);
}

TEST(Certified_soak, takes_right_answers) {
  EXPECT_TRUE(is_right_answer({.collides = true}, true_pairs));
  EXPECT_TRUE(is_right_answer({.collides = true}, {{1, 2}}, {.contacts = Contact_query::first}));
  EXPECT_TRUE(is_right_answer({.collides = true}, {}, {.contacts = Contact_query::yes_no}));
  EXPECT_TRUE(is_right_answer({.collides = true, .capped = true}, {{0, 4}, {7, 3}},
                              {.contacts = Contact_query::all, .most_contacts = 2}));
  EXPECT_TRUE(is_right(Frame(), Frame(), {1, 2}, {}));
}

TEST(Certified_soak, notices_wrong_answers) {
  EXPECT_FALSE(is_right_answer({.collides = false}, true_pairs));
  EXPECT_FALSE(is_right_answer({.collides = true, .near = true}, true_pairs));
  EXPECT_FALSE(is_right_answer({.collides = true, .containment = Containment::a_in_b}, true_pairs));
  EXPECT_FALSE(is_right_answer({.collides = true, .parting = Parting()}, true_pairs));
  EXPECT_FALSE(is_right(Frame(), true_frame, {1, 2}, {})) << "the pair is lost";
}

TEST(Certified_soak, notices_wrong_contacts) {
  EXPECT_FALSE(is_right_answer({.collides = true}, {{0, 4}, {1, 2}})) << "one is missing";
  EXPECT_FALSE(is_right_answer({.collides = true}, {{0, 4}, {1, 2}, {7, 4}})) << "another face";
  EXPECT_FALSE(is_right_answer({.collides = true, .capped = true}, true_pairs)) << "none was cut off";
  EXPECT_FALSE(is_right_answer({.collides = true}, {}, {.contacts = Contact_query::first}));
  EXPECT_FALSE(is_right_answer({.collides = true}, {{1, 3}}, {.contacts = Contact_query::first}));
}

std::vector<double> coordinates_of(const Surface_mesh& mesh) {
  std::vector<double> coordinates;
  for (const auto& p : mesh.points()) coordinates.insert(coordinates.end(), {p.x(), p.y(), p.z()});
  return coordinates;
}

/// A ball that grows by half, and says that it stays in its box at rest, a little wider.
class Liar : public Random_body {
 public:
  explicit Liar(double margin)
      : Random_body(icosphere(3)),
        promise_([margin](Region_index, const Aabb& rest) {
          Aabb box = rest;
          for (int axis = 0; axis < 3; ++axis) box.low[axis] -= margin, box.high[axis] += margin;
          return box;
        }),
        points_(coordinates_of(mesh_), std::vector{Morph_target{.offsets = coordinates_of(mesh_)}}) {}
  Object_id add_to(Detector<>& detector) const override { return detector.add(mesh_); }
  void move(const Eigen::Vector3d&, Random&) override { points_.set_weights(std::vector{0.5}); }
  const Position_source& positions() const override { return positions_; }
  std::unique_ptr<Node_bound> bound(const Bounded_object& object) const override {
    return std::make_unique<Node_bound_of<Promised_boxes>>(promise_.bound(object));
  }

 private:
  Box_promise promise_;
  Morphed_points points_;
  Computed_source<Morphed_points> positions_{points_};
};

TEST(Certified_soak, notices_vertices_outside_the_boxes_of_a_bound) {
  Random random(1);
  for (const auto& [margin, lies] : {std::pair(0.1, true), {9.0, false}}) {
    Liar body(margin);
    Bound_check check(body, 8);
    EXPECT_EQ(check.check(random).outside, 0U);
    body.move({}, random);
    const auto count = check.check(random);
    EXPECT_GT(count.boxes, 0U);
    EXPECT_EQ(count.outside > 0, lies);
  }
}

}  // namespace
}  // namespace lodestone
