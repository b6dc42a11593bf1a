// SPDX-License-Identifier: GPL-3.0-or-later
// Mode exact with any volumes in its trees gives the answers of exhaustive checking. Instantiated for every model, in
// several files, since each takes long to compile.
#pragma once

#include <cmath>
#include <cstddef>
#include <deque>
#include <tuple>
#include <utility>
#include <vector>

#include "contract/volume_models.h"
#include "lodestone/io/shapes/shapes.h"
#include "lodestone/triangles/neighbour_check.h"
#include "support/exact_truth.h"

namespace lodestone {

/// Every `step`-th of the models, from index `first` on.
template <std::size_t first, std::size_t step>
struct Some_volumes {
  template <class Places>
  struct At;
  template <std::size_t... i>
  struct At<std::index_sequence<i...>> {
    using type = ::testing::Types<std::tuple_element_t<first + step * i, Bounding_volumes>...>;
  };
  static constexpr std::size_t count = (std::tuple_size_v<Bounding_volumes> + step - 1 - first) / step;
  using type = typename At<std::make_index_sequence<count>>::type;
};

/// Closed, open, knotted and degenerate surfaces about the origin that meet each other here and there.
inline std::deque<Surface_mesh> several_surfaces() {
  std::deque<Surface_mesh> meshes;
  meshes.push_back(potato(4));
  meshes.push_back(torus_knot({.radius = 0.7, .tube = 0.1, .segments = 40, .sides = 5}));
  meshes.push_back(cloth(9, 8));
  meshes.push_back(sphere(4, 0.5, {1.2, 0.3, 0}));
  auto folded = grid(6, 6);  // two rows on one line, two coinciding vertices
  deform(folded, [](const Point& p) { return Point(p.x() - 2.5, (p.y() == 2 ? 3 : p.y()) - 3, 0.25 * p.x()); });
  folded.point(Surface_mesh::Vertex_index(8)) = folded.point(Surface_mesh::Vertex_index(7));
  meshes.push_back(folded);
  meshes.push_back(single_triangle());
  return meshes;
}

/// Moves the surfaces to another frame.
inline void next_frame(std::deque<Surface_mesh>& meshes, int frame) {
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const double phase = static_cast<double>(i) + 0.7 * frame;
    deform(meshes[i], [&](const Point& p) {
      return Point(p.x() + 0.2 * std::sin(phase), p.y() + 0.1 * std::sin(3 * p.x() + phase),
                   p.z() + 0.2 * std::cos(2 * phase));
    });
    if (frame % 3 == 2) crumple(meshes[i], 0.03, i);
  }
}

inline std::vector<Positions> all_positions(const std::deque<Surface_mesh>& meshes) {
  std::vector<Positions> positions;
  for (const auto& mesh : meshes) positions.push_back(positions_of(mesh));
  return positions;
}

/// Intersecting pairs of faces of one mesh: those that share no vertex by exhaustive checking, the others one by one.
inline std::vector<Face_pair> pairs_within(const Surface_mesh& mesh) {
  const Numbered_mesh numbered(mesh);
  const auto& [positions, faces] = std::tie(numbered.positions, numbered.faces);
  std::vector<Face_pair> pairs;
  const auto vertex_count = static_cast<std::uint32_t>(positions.rows());
  Neighbour_check neighbours;
  neighbours.check(Vertex_fans(vertex_count, faces), faces,
                   {positions.data(), static_cast<std::size_t>(positions.size())}, 0, vertex_count, pairs);
  for (const auto& pair : exhaustive_numbered(positions, faces, positions, faces)) {
    const auto shares = [&](std::uint32_t v) { return std::ranges::count(faces[pair.b], v) > 0; };
    if (pair.a < pair.b && std::ranges::none_of(faces[pair.a], shares)) pairs.push_back(pair);
  }
  std::ranges::sort(pairs);
  return pairs;
}

template <class Volume>
class Detector_volume_contract : public ::testing::Test {};
TYPED_TEST_SUITE_P(Detector_volume_contract);

TYPED_TEST_P(Detector_volume_contract, all_pairs_of_deforming_surfaces_are_found_with_any_number_of_threads) {
  auto meshes = several_surfaces();
  for (const std::size_t leaf_faces : {4, 64}) {
    Volume_detector<TypeParam> alone({.mode = Mode::exact, .tree = {.leaf_faces = leaf_faces}});
    Volume_detector<TypeParam> shared({.mode = Mode::exact, .threads = 2, .tree = {.leaf_faces = leaf_faces}});
    add_all(alone, all_of(meshes));
    add_all(shared, all_of(meshes));
    std::size_t colliding = 0;
    for (int frame = 0; frame < 6; ++frame) {
      const Frame& found = alone.detect();
      colliding += expect_exhaustive(found, all_of(meshes));
      expect_same_frame(shared.detect(), found);
      for (Object_id object = 0; object < meshes.size(); ++object) {
        const Numbered_mesh mesh(meshes[object]);
        EXPECT_EQ(alone.tree(object).validate(mesh.faces, mesh.coordinates()), "");
      }
      next_frame(meshes, frame);
    }
    EXPECT_GT(colliding, 20U);
  }
}

TYPED_TEST_P(Detector_volume_contract, all_pairs_are_found_in_any_unit_and_far_from_the_origin) {
  std::vector<std::size_t> found;
  for (const auto& [unit, offset] :
       {std::pair{1.0, 0.0}, {0x1p-300, 0.0}, {0x1p300, 0.0}, {1.0, 0x1p20}, {0x1p1015, 0.0}}) {
    auto meshes = several_surfaces();
    const auto frame = [&, unit = unit, offset = offset] {
      auto now = meshes;
      for (std::size_t i = 0; i < meshes.size(); ++i)
        place(now[i], unit * (positions_of(meshes[i]).array() + offset).matrix());
      return now;
    };
    auto placed_meshes = frame();
    Volume_detector<TypeParam> detector({.mode = Mode::exact, .tree = {.leaf_faces = 8}});
    add_all(detector, all_of(placed_meshes));
    found.push_back(0);
    for (int i = 0; i < 3; ++i) {
      const auto now = all_positions(frame());
      for (std::size_t k = 0; k < meshes.size(); ++k) place(placed_meshes[k], now[k]);
      const Frame& result = detector.detect();
      EXPECT_GT(expect_exhaustive(result, all_of(placed_meshes)), 0U) << unit << ", " << offset;
      found.back() += result.face_pairs.size();
      next_frame(meshes, i);
    }
  }
  EXPECT_EQ(found[1], found[0]);
  EXPECT_EQ(found[2], found[0]);
}

TYPED_TEST_P(Detector_volume_contract, yes_or_no_and_first_contacts_agree_with_exhaustive_checking) {
  auto meshes = several_surfaces();
  for (const auto query : {Contact_query::yes_no, Contact_query::first}) {
    Volume_detector<TypeParam> detector({.mode = Mode::exact, .contacts = query, .tree = {.leaf_faces = 8}});
    add_all(detector, all_of(meshes));
    std::size_t colliding = 0;
    for (int frame = 0; frame < 4; ++frame) {
      const Frame& found = detector.detect();
      for (Object_id a = 0; a < meshes.size(); ++a)
        for (Object_id b = a + 1; b < meshes.size(); ++b) {
          const auto truth = exhaustive_face_pairs(meshes[a], meshes[b]);
          const auto contacts = contacts_of(found, a, b);
          const auto* result = result_of(found, a, b);
          EXPECT_EQ(result != nullptr && result->collides, !truth.empty());
          EXPECT_EQ(contacts.size(), query == Contact_query::first && !truth.empty() ? 1U : 0U);
          EXPECT_TRUE(std::ranges::includes(truth, contacts));
          colliding += truth.empty() ? 0 : 1;
        }
      next_frame(meshes, frame);
    }
    EXPECT_GT(colliding, 10U);
  }
}

TYPED_TEST_P(Detector_volume_contract, pairs_within_a_tolerance_are_found) {
  std::deque<Surface_mesh> meshes{potato(3), sphere(3, 0.5, {2.1, 0.2, 0}), cloth(5, 5)};
  for (const double tolerance : {0.01, 0.3}) {
    Volume_detector<TypeParam> detector(
        {.mode = Mode::exact, .exact = {.tolerance = tolerance}, .tree = {.leaf_faces = 4}});
    add_all(detector, all_of(meshes));
    std::size_t found = 0;
    for (int frame = 0; frame < 4; ++frame) {
      const Frame& result = detector.detect();
      for (Object_id a = 0; a < meshes.size(); ++a)
        for (Object_id b = a + 1; b < meshes.size(); ++b)
          expect_near_contacts(result, a, b, meshes[a], meshes[b], tolerance);
      found += result.face_pairs.size();
      next_frame(meshes, frame);
    }
    EXPECT_GT(found, 20U);
  }
}

TYPED_TEST_P(Detector_volume_contract, self_collisions_are_found) {
  std::size_t found = 0;
  for (const std::size_t threads : {1, 2}) {
    std::deque<Surface_mesh> meshes{cloth(12, 12), torus_knot({.tube = 0.4, .segments = 40, .sides = 6})};
    Volume_detector<TypeParam> detector(
        {.mode = Mode::exact, .exact = {.self_collision = true}, .threads = threads, .tree = {.leaf_faces = 8}});
    add_all(detector, all_of(meshes));
    for (int frame = 0; frame < 4; ++frame) {
      const Frame& result = detector.detect();
      for (Object_id object = 0; object < meshes.size(); ++object) {
        const auto truth = pairs_within(meshes[object]);
        expect_contacts(result, object, object, truth);
        found += truth.size();
      }
      expect_contacts(result, 0, 1, exhaustive_face_pairs(meshes[0], meshes[1]));
      for (auto& mesh : meshes) crumple(mesh, 0.05, static_cast<std::uint64_t>(frame));
    }
  }
  EXPECT_GT(found, 500U);
}

TYPED_TEST_P(Detector_volume_contract, the_closest_faces_are_found) {
  std::deque<Surface_mesh> meshes{potato(4), sphere(3, 0.5, {2.5, 0.2, 0}), cloth(6, 6)};
  Volume_detector<TypeParam> detector({.mode = Mode::exact, .tree = {.leaf_faces = 4}});
  add_all(detector, all_of(meshes));
  std::size_t apart = 0;
  for (int frame = 0; frame < 5; ++frame) {
    for (const auto& [a, b] : {std::pair<Object_id, Object_id>{0, 1}, {1, 2}, {2, 0}}) {
      const auto closest = detector.closest(a, b);
      const double distance = distance_of(meshes[a], meshes[b]);
      EXPECT_EQ(closest.points.distance, distance) << frame;
      EXPECT_EQ(
          closest_points(triangle_of(meshes[a], closest.faces.a), triangle_of(meshes[b], closest.faces.b)).distance,
          distance);
      apart += distance > 0 ? 1 : 0;
    }
    next_frame(meshes, frame);
  }
  EXPECT_GT(apart, 5U);
}

TYPED_TEST_P(Detector_volume_contract, the_first_impact_is_that_of_boxes) {
  auto a = sphere(4), b = sphere(4, 0.5, {3, 0.2, 0});
  const Positions end_a = Numbered_mesh(a).positions.rowwise() + Eigen::RowVector3d(4, 0, 0.1),
                  end_b = Numbered_mesh(b).positions.rowwise() - Eigen::RowVector3d(4, 0.1, 0);
  Volume_detector<TypeParam> detector({.mode = Mode::exact, .tree = {.leaf_faces = 4}});
  Detector<> boxes;
  add_all(detector, {&a, &b}), add_all(boxes, {&a, &b});
  const auto impact = detector.first_impact(0, end_a, 1, end_b), of_boxes = boxes.first_impact(0, end_a, 1, end_b);
  ASSERT_TRUE(impact && of_boxes);
  EXPECT_EQ(impact->time, of_boxes->time);
  EXPECT_EQ(impact->faces, of_boxes->faces);
  EXPECT_EQ(impact->point, of_boxes->point);
}

TYPED_TEST_P(Detector_volume_contract, objects_inside_others_are_found) {
  auto outer = sphere(6), inner = sphere(3, 0.3), other = sphere(3, 0.2, {0, 5, 0});
  Volume_detector<TypeParam> detector({.mode = Mode::exact, .exact = {.containment = true}, .tree = {.leaf_faces = 4}});
  add_all(detector, {&outer, &inner, &other});
  for (const auto& [x, expected] : {std::pair{0.0, Containment::b_in_a},
                                    {0.5, Containment::b_in_a},
                                    {1.0, Containment::none},
                                    {2.0, Containment::none}}) {
    place(inner, positions_of(sphere(3, 0.3, {x, 0.01, 0.02})));
    const Frame& frame = detector.detect();
    const auto* result = result_of(frame, 0, 1);
    EXPECT_EQ(result == nullptr ? Containment::none : result->containment, expected) << x;
    EXPECT_EQ(result != nullptr && result->collides, x == 1.0);
    EXPECT_EQ(detector.contains(0, 1), expected == Containment::b_in_a) << x;
    EXPECT_FALSE(detector.contains(1, 0));
    EXPECT_FALSE(detector.contains(0, 2));
  }
}

TYPED_TEST_P(Detector_volume_contract, translations_that_part_objects_are_those_of_boxes) {
  auto meshes = several_surfaces();
  meshes.push_back(sphere(3, 0.1, {1.2, 0.3, 0}));  // inside another
  const Detector_options options{.mode = Mode::exact, .exact = {.parting = true}, .tree = {.leaf_faces = 8}};
  Volume_detector<TypeParam> detector(options);
  Exact_detector boxes({.mode = Mode::exact, .exact = {.parting = true}});
  add_all(detector, all_of(meshes));
  add_all(boxes, all_of(meshes));
  const Frame &found = detector.detect(), &expected = boxes.detect();
  std::size_t given = 0;
  for (const auto& pair : expected.pairs) {
    if (!pair.parting) continue;
    ++given;
    ASSERT_TRUE(result_of(found, pair.a, pair.b)->parting);
    EXPECT_EQ(result_of(found, pair.a, pair.b)->parting->translation, pair.parting->translation);
  }
  EXPECT_GT(given, 4U);
}

TYPED_TEST_P(Detector_volume_contract, points_and_normals_of_contacts_are_those_of_boxes) {
  auto meshes = several_surfaces();
  const Detector_options options{.mode = Mode::exact, .contact_points = true, .contact_normals = true};
  Volume_detector<TypeParam> detector(options);
  Exact_detector boxes(options);
  add_all(detector, all_of(meshes));
  add_all(boxes, all_of(meshes));
  const Frame &found = detector.detect(), &expected = boxes.detect();
  EXPECT_GT(found.face_pairs.size(), 20U);
  EXPECT_EQ(found.face_pairs, expected.face_pairs);
  EXPECT_EQ(found.contact_points, expected.contact_points);
  expect_same_normals(found.contact_normals, expected.contact_normals);
}

REGISTER_TYPED_TEST_SUITE_P(Detector_volume_contract,
                            all_pairs_of_deforming_surfaces_are_found_with_any_number_of_threads,
                            all_pairs_are_found_in_any_unit_and_far_from_the_origin,
                            yes_or_no_and_first_contacts_agree_with_exhaustive_checking,
                            pairs_within_a_tolerance_are_found, self_collisions_are_found, the_closest_faces_are_found,
                            the_first_impact_is_that_of_boxes, objects_inside_others_are_found,
                            translations_that_part_objects_are_those_of_boxes,
                            points_and_normals_of_contacts_are_those_of_boxes);

}  // namespace lodestone
