// SPDX-License-Identifier: GPL-3.0-or-later
// A scene for mode certified, and the comparison with mode exact.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "lodestone/detector.h"
#include "lodestone/mesh/computed_points.h"
#include "lodestone/mesh/skinned_points.h"
#include "lodestone/volumes/bounding_sphere.h"
#include "support/exact_truth.h"
#include "support/face_soup.h"

namespace lodestone {

inline Surface_mesh long_body(int parts, std::uint64_t seed) {
  auto mesh = potato(parts, seed);
  deform(mesh, [](const Point& p) { return Point(2 * p.x(), 0.6 * p.y(), 0.6 * p.z()); });
  return mesh;
}

/// A limb along x whose ends follow two joints.
inline Skinned_points limb(const Surface_mesh& mesh) {
  const auto rest = Face_soup(mesh).coordinates;
  std::vector<std::uint32_t> joints;
  std::vector<double> weights;
  for (std::size_t v = 0; v < rest.size() / 3; ++v) {
    const double second = std::clamp(rest[3 * v] + 0.5, 0.0, 1.0);
    joints.insert(joints.end(), {0, 1});
    weights.insert(weights.end(), {1 - second, second});
  }
  return {rest, Joint_influences::of(2, joints, weights), 2};
}

inline void bend(Skinned_points& points, double angle, const Eigen::Vector3d& at) {
  const Eigen::Translation3d there(at);
  points.set_joints(std::vector<Eigen::Affine3d>{
      Eigen::Affine3d(there), there * Eigen::Affine3d(Eigen::AngleAxisd(angle, Eigen::Vector3d(0, 0.6, 0.8)))});
}

inline Morphed_points swelling(const Surface_mesh& mesh) {
  Morph_target larger;
  larger.offsets = Face_soup(mesh).coordinates;
  return Morphed_points(Face_soup(mesh).coordinates, std::vector{larger});
}

/// Two limbs, a body that swells, and one that moves without saying how.
struct Certified_scene {
  Surface_mesh upper = long_body(9, 1), lower = long_body(8, 2), round = potato(6, 3), plain = potato(7, 4);
  Skinned_points upper_points = limb(upper), lower_points = limb(lower);
  Morphed_points round_points = swelling(round);

  void add_to(Detector<>& detector) {
    detector.add(upper, point_map(upper, upper_points), {.name = "upper"});
    detector.add(lower, point_map(lower, lower_points));
    detector.add(round, point_map(round, round_points));
    detector.add(std::as_const(plain));
  }
  void pose(int frame) {
    const double t = frame;
    bend(upper_points, 0.3 * t, {0, 0, 1.4 * std::cos(0.5 * t)});
    bend(lower_points, -0.4 * t, {0.5 * std::sin(t), 0, 0});
    round_points.set_weights(std::vector{0.5 * std::sin(0.7 * t)});
    shift(plain, 0, std::sin(1.3 * t), 0.6 * std::cos(0.9 * t));
  }
};

inline Detector_options in_mode(Mode mode, Detector_options options) {
  options.mode = mode;
  options.tree.leaf_faces = 24;
  return options;
}

inline Pair_result result_or_none(const Frame& frame, Object_id a, Object_id b) {
  const auto* result = result_of(frame, a, b);
  return result == nullptr ? Pair_result{} : *result;
}

/// The two frames list the same contacts, and the same of all that depends on them.
inline void expect_same_answers(const Frame& found, const Frame& truth, Object_id objects) {
  for (Object_id a = 0; a < objects; ++a)
    for (Object_id b = a; b < objects; ++b) {
      SCOPED_TRACE(testing::Message() << a << ", " << b);
      const Pair_result one = result_or_none(found, a, b), other = result_or_none(truth, a, b);
      EXPECT_EQ(one.collides, other.collides);
      EXPECT_EQ(one.near, other.near);
      EXPECT_EQ(one.capped, other.capped);
      EXPECT_EQ(one.containment, other.containment);
      EXPECT_EQ(one.patches, other.patches);
      EXPECT_EQ(one.parting.has_value(), other.parting.has_value());
      if (one.parting && other.parting) {
        EXPECT_EQ(one.parting->translation, other.parting->translation);
      }
    }
  EXPECT_EQ(found.face_pairs, truth.face_pairs);
  EXPECT_EQ(found.contact_points, truth.contact_points);
  EXPECT_EQ(found.contact_normals.size(), truth.contact_normals.size());
}

inline std::vector<Detector_options> questions() {
  return {{},
          {.contacts = Contact_query::yes_no},
          {.contacts = Contact_query::yes_no, .exact = {.tolerance = 0.1}},
          {.exact = {.tolerance = 0.1}},
          {.contact_points = true, .contact_normals = true, .exact = {.patches = true}},
          {.exact = {.self_collision = true, .containment = true, .parting = true}},
          {.particles = 4, .exact = {.tolerance = 0.05}, .threads = 0}};
}

}  // namespace lodestone
