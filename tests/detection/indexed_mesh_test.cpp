// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes given as arrays: the same answers as for a half-edge mesh, and faces that such a mesh cannot hold.
#include "lodestone/mesh/indexed_mesh.h"

#include <gtest/gtest.h>

#include <limits>
#include <type_traits>
#include <utility>

#include "lodestone/find_collisions.h"
#include "lodestone/mesh/skinned_points.h"
#include "lodestone/partition/partition_measures.h"
#include "support/exact_truth.h"
#include "support/message_of.h"

namespace lodestone {
namespace {

/// The arrays of a mesh.
struct Arrays {
  explicit Arrays(const Surface_mesh& mesh) : corners(Mesh_numbering<Surface_mesh>(mesh).corners()) { read(mesh); }
  void read(const Surface_mesh& mesh) {
    coordinates.clear();
    for (const auto& p : mesh.points()) coordinates.insert(coordinates.end(), {p.x(), p.y(), p.z()});
  }
  std::vector<double> coordinates;
  std::vector<Corners> corners;
};

const Detector_options everything{.contact_points = true,
                                  .contact_normals = true,
                                  .exact = {.self_collision = true, .containment = true, .parting = true, .patches = true}};

template <class Numbers, class Faces>
concept Takes_arrays = requires(Indexed_mesh& mesh, Numbers&& numbers, Faces&& faces) {
  mesh.set_arrays(std::forward<Numbers>(numbers), std::forward<Faces>(faces));
};
template <class Numbers>
concept Takes_list_of_faces = requires(Numbers&& numbers, const Corners* first) {
  Indexed_mesh(std::forward<Numbers>(numbers), {first, std::size_t{1}});
};
template <class Numbers>
concept Takes_coordinates = requires(Indexed_mesh& mesh, Numbers&& numbers) {
  mesh.set_coordinates(std::forward<Numbers>(numbers));
};

TEST(Indexed_mesh, gives_the_frames_of_a_half_edge_mesh) {
  for (auto options : {Detector_options{.mode = Mode::particles, .particles = 12}, Detector_options{.mode = Mode::senin},
                       everything, Detector_options{.particles = 8}}) {
    Surface_mesh a = potato(6), b = potato(5, 2);
    Arrays arrays_a(a), arrays_b(b);
    const Indexed_mesh indexed_a(arrays_a.coordinates, arrays_a.corners), indexed_b(arrays_b.coordinates, arrays_b.corners);
    Detector half_edges(options), arrays(options);
    half_edges.add(a), half_edges.add(b);
    arrays.add(indexed_a), arrays.add(indexed_b);
    for (int frame = 0; frame < 4; ++frame) {
      shift(b, 0.4, 0.1, -0.05);
      std::ranges::copy(Arrays(b).coordinates, arrays_b.coordinates.begin());  // the detector reads them where they are
      half_edges.update(), arrays.update();
      expect_same_frame(half_edges.detect(), arrays.detect());
    }
  }
}

TEST(Indexed_mesh, takes_other_coordinates_of_as_many_vertices) {
  const Arrays arrays(potato(5));
  Surface_mesh moved = potato(5);
  shift(moved, 0.5);
  const Arrays elsewhere(moved);
  Indexed_mesh mesh(arrays.coordinates, arrays.corners);
  const Indexed_mesh other(arrays.coordinates, arrays.corners);
  Detector detector;
  detector.add(mesh), detector.add(other);
  detector.detect();
  mesh.set_coordinates(elsewhere.coordinates);
  EXPECT_EQ(detector.detect().face_pairs, exhaustive_face_pairs(moved, potato(5)));
  EXPECT_EQ(message_of<Bad_mesh>([&] { mesh.set_coordinates({}); }), "the mesh has 306 coordinates, but got 0");
}

TEST(Indexed_mesh, refuses_arrays_that_do_not_fit_together) {
  const std::vector<double> coordinates(9, 0.0);
  const std::vector<double> odd(10, 0.0);
  const std::vector<Corners> good{{0, 1, 2}}, beyond{{0, 1, 2}, {0, 3, 1}}, none;
  EXPECT_EQ(message_of<Bad_mesh>([&] { Indexed_mesh(Coordinates(coordinates), beyond); }),
            "face 1 refers to vertex 3 of 3");
  EXPECT_EQ(message_of<Bad_mesh>([&] { Indexed_mesh(Coordinates(odd), good); }),
            "there are 10 coordinates, which is not three per vertex");
  const Indexed_mesh empty(coordinates, none), mesh(coordinates, good);
  Detector detector;
  EXPECT_EQ(message_of<Bad_mesh>([&] { detector.add(empty); }), "the mesh has no face");
  detector.add(mesh);
  EXPECT_EQ(message_of<Bad_argument>([&] { detector.add(mesh); }), "the mesh has been added before");
}

TEST(Indexed_mesh, cannot_be_made_of_arrays_that_end_with_the_call) {
  using Numbers = std::vector<double>;
  using Faces = std::vector<Corners>;
  static_assert(std::is_constructible_v<Indexed_mesh, Numbers&, Faces&>);
  static_assert(std::is_constructible_v<Indexed_mesh, const Numbers&, const Faces&>);
  static_assert(!std::is_constructible_v<Indexed_mesh, Numbers, Faces&>);
  static_assert(!std::is_constructible_v<Indexed_mesh, Numbers&, Faces>);
  static_assert(!std::is_constructible_v<Indexed_mesh, Numbers, Faces>);
  static_assert(Takes_list_of_faces<Numbers&> && !Takes_list_of_faces<Numbers>);
  static_assert(Takes_arrays<Numbers&, Faces&> && !Takes_arrays<Numbers&, Faces>);
  static_assert(!Takes_arrays<Numbers, Faces&> && !Takes_arrays<Numbers, Faces>);
  static_assert(Takes_coordinates<Numbers&> && !Takes_coordinates<Numbers>);
}

/// The array of faces is the caller's, who can write into it at any time.
TEST(Indexed_mesh, refuses_corners_that_have_become_wrong_wherever_faces_are_read) {
  for (const std::uint32_t wrong : {0U, 500'000'000U}) {
    Arrays arrays(potato(5)), others(potato(4));
    const Indexed_mesh mesh(arrays.coordinates, arrays.corners), other(others.coordinates, others.corners);
    Detector detector;
    const Object_id id = detector.add(mesh);
    detector.add(other);
    const auto before = detector.detect().face_pairs;
    const auto vertices = static_cast<std::uint32_t>(arrays.coordinates.size() / 3);
    const Corners right = arrays.corners[7];
    arrays.corners[7][1] = std::max(wrong, vertices);
    const std::string message = "face 7 refers to vertex " + std::to_string(arrays.corners[7][1]);
    EXPECT_EQ(detector.detect().face_pairs, before) << "faces are those of the last rebuild";
    const std::vector<std::uint32_t> changed{7};
    const auto expect_refused = [&](const auto& use) {
      EXPECT_NE(message_of<Bad_mesh>(use).find(message), std::string::npos);
    };
    expect_refused([&] { detector.rebuild(id, Changed_faces{changed}); });
    expect_refused([&] {
      detector.rebuild(id);
      detector.detect();
    });
    expect_refused([&] { find_collisions(mesh, other); });
    expect_refused([&] { find_self_collisions(mesh); });
    arrays.corners[7] = right;
    detector.rebuild(id);
    EXPECT_EQ(detector.detect().face_pairs, before);
  }
}

TEST(Indexed_mesh, names_a_coordinate_that_is_not_finite) {
  Arrays arrays(tetrahedron());
  arrays.coordinates[4] = std::numeric_limits<double>::quiet_NaN();
  const Indexed_mesh mesh(arrays.coordinates, arrays.corners);
  Detector detector;
  detector.add(mesh);
  EXPECT_THROW(detector.detect(), Bad_mesh);
}

TEST(Indexed_mesh, holds_edges_of_three_faces_faces_without_area_and_vertices_without_faces) {
  // Three faces at one edge, one of them twice and turned around; a face that names a vertex twice; a lone vertex.
  const std::vector<double> coordinates{0, 0, 0, 0, 0, 1, 1, 0, 0, -1, 1, 0, -1, -1, 0, 9, 9, 9};
  const std::vector<Corners> faces{{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {1, 0, 4}, {2, 2, 3}};
  const Indexed_mesh pages(coordinates, faces);
  const Surface_mesh other = potato(4);
  const Arrays arrays(other);
  const Indexed_mesh ball(arrays.coordinates, arrays.corners);
  std::vector<Face_pair> truth;
  for (std::uint32_t f = 0; f < faces.size(); ++f)
    for (std::uint32_t g = 0; g < arrays.corners.size(); ++g)
      if (triangles_intersect(face_triangle(faces[f], [&](auto v) { return coordinates.data() + 3 * std::size_t{v}; }),
                              triangle_of(other, g)))
        truth.push_back({f, g});
  ASSERT_FALSE(truth.empty());
  EXPECT_EQ(find_collisions(pages, ball).faces, truth);
  for (const auto mode : {Mode::exact, Mode::particles, Mode::senin, Mode::certified}) {
    Detector detector({.mode = mode});
    detector.add(pages), detector.add(ball);
    const Frame& frame = detector.detect();
    EXPECT_TRUE(std::ranges::includes(truth, frame.face_pairs));
    if (finds_all(mode)) {
      EXPECT_EQ(frame.face_pairs, truth);
    }
  }
  // Faces that share a vertex meet beyond it only where one is there twice, or has no area and crosses another.
  const auto self = find_self_collisions(pages);
  EXPECT_TRUE(std::ranges::find(self.faces, Face_pair{2, 3}) != self.faces.end());
  EXPECT_TRUE(std::ranges::find(self.faces, Face_pair{0, 1}) == self.faces.end());
}

TEST(Indexed_mesh, is_rebuilt_with_other_faces) {
  const Surface_mesh before = potato(5), after = potato(6), other = potato(4, 2);
  const Arrays first(before), second(after), ball(other);
  Indexed_mesh mesh(first.coordinates, first.corners);
  const Indexed_mesh fixed(ball.coordinates, ball.corners);
  Detector detector;
  const auto id = detector.add(mesh);
  detector.add(fixed);
  EXPECT_EQ(detector.detect().face_pairs, exhaustive_face_pairs(before, other));
  mesh.set_arrays(second.coordinates, second.corners);
  EXPECT_THROW(detector.detect(), Bad_mesh);
  detector.rebuild(id);
  EXPECT_EQ(detector.detect().face_pairs, exhaustive_face_pairs(after, other));
  // One edge flipped.
  auto flipped = second.corners;
  std::swap(flipped[0][0], flipped[0][1]);
  flipped[3] = flipped[2];
  mesh.set_arrays(second.coordinates, flipped);
  detector.rebuild(id, Changed_faces{std::vector<std::uint32_t>{0, 3}});
  const Indexed_mesh anew(second.coordinates, flipped);
  EXPECT_EQ(detector.detect().face_pairs, find_collisions(anew, fixed).faces);
}

TEST(Indexed_mesh, carries_regions_and_particles) {
  const Arrays a(potato(6)), b(potato(5, 2));
  Indexed_mesh mesh(a.coordinates, a.corners);
  const Indexed_mesh other(b.coordinates, b.corners);
  Detector detector({.mode = Mode::particles, .particles = 12});
  const auto id = detector.add(mesh);
  detector.add(other);
  detector.detect();
  const auto& maps = detector.maps<Indexed_mesh>(id);
  const auto& object = detector.object(id);
  std::size_t particles = 0;
  for (const auto v : vertices(mesh)) {
    EXPECT_LT(get(maps.region(), v), 12U);
    if (get(maps.particle(), v) != no_particle) ++particles;
  }
  EXPECT_EQ(particles, object.particles().at.size());
}

TEST(Indexed_mesh, is_divided_like_a_half_edge_mesh) {
  Surface_mesh half_edges = potato(8);
  const Arrays arrays(half_edges);
  const Indexed_mesh mesh(arrays.coordinates, arrays.corners);
  auto labels = Region_property<Surface_mesh>::add(half_edges, "v:label");
  boost::vector_property_map<Region_index> indexed_labels;
  const auto expected = partition(half_edges, 16, labels, Lbg{});
  const auto found = partition(mesh, 16, indexed_labels, Lbg{});
  for (const auto v : half_edges.vertices()) EXPECT_EQ(get(indexed_labels, v.idx()), labels[v]);
  EXPECT_EQ(measure_partition(mesh, found, indexed_labels).distortion,
            measure_partition(half_edges, expected, labels).distortion);
}

TEST(Indexed_mesh, can_have_computed_positions) {
  const Arrays arrays(potato(6)), ball(potato(5, 2));
  const Indexed_mesh mesh(arrays.coordinates, arrays.corners), other(ball.coordinates, ball.corners);
  const std::vector<std::uint32_t> joints(num_vertices(mesh), 0);
  Skinned_points skin(arrays.coordinates, Joint_influences::of(1, joints, std::vector<double>(joints.size(), 1.0)), 1);
  Detector detector({.mode = Mode::certified});
  detector.add(mesh, point_map(mesh, skin)), detector.add(other);
  for (const double x : {0.0, 0.7, 1.9, 5.0}) {
    skin.set_joints(std::vector{Eigen::Affine3d(Eigen::Translation3d(x, 0, 0))});
    Surface_mesh moved = potato(6);
    shift(moved, x);
    EXPECT_EQ(detector.detect().face_pairs, exhaustive_face_pairs(moved, potato(5, 2)));
  }
}

TEST(Detector_queries, within_agrees_with_the_closest_faces_and_is_strict) {
  for (const auto mode : {Mode::exact, Mode::certified}) {
    const Surface_mesh a = cube(3);
    Surface_mesh b = cube(3);
    shift(b, 1.5);  // the cubes are 0.5 apart
    Detector detector({.mode = mode});
    detector.add(a), detector.add(b);
    EXPECT_FALSE(detector.within(0, 1, 0));
    EXPECT_FALSE(detector.within(0, 1, 0.5));
    EXPECT_TRUE(detector.within(0, 1, std::nextafter(0.5, 1)));
    EXPECT_TRUE(detector.within(1, 0, 100));
    shift(b, -0.5);
    EXPECT_TRUE(detector.within(0, 1, 0)) << "they touch";
    EXPECT_THROW(detector.within(0, 0, 1), Bad_argument);
    EXPECT_THROW(detector.within(0, 1, -1), Bad_argument);
    EXPECT_THROW(detector.within(0, 1, std::numeric_limits<double>::infinity()), Bad_argument);
    EXPECT_THROW(detector.within(0, 2, 1), Bad_argument);
  }
  Detector particles({.mode = Mode::particles});
  const Surface_mesh a = cube(2), b = cube(3);
  particles.add(a), particles.add(b);
  EXPECT_THROW(particles.within(0, 1, 1), Bad_argument);
}

TEST(Detector_queries, about_many_rays_and_points_are_those_about_each) {
  const Surface_mesh mesh = potato(8);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> number(-2, 2);
  std::vector<Ray> rays;
  std::vector<Point> points;
  for (int i = 0; i < 50; ++i) {
    rays.push_back({.origin = {number(random), number(random), number(random)},
                    .direction = {number(random), number(random), number(random)}});
    points.emplace_back(number(random), number(random), number(random));
  }
  Detector detector;
  detector.add(mesh);
  const auto hits = detector.first_hits(0, rays);
  const auto nearest = detector.closest_points(0, points);
  const auto sides = detector.point_sides(0, points);
  ASSERT_EQ(hits.size(), rays.size());
  std::size_t met = 0, inside = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto hit = detector.first_hit(0, rays[i]);
    const auto of_tree = first_hit(detector.ray_tree(0), rays[i]);
    ASSERT_EQ(hits[i].has_value(), hit.has_value());
    ASSERT_EQ(of_tree.has_value(), hit.has_value());
    if (hit) {
      EXPECT_EQ(hits[i]->face, hit->face);
      EXPECT_EQ(hits[i]->t, hit->t);
      EXPECT_EQ(of_tree->face, hit->face);
      EXPECT_EQ(of_tree->t, hit->t);
      ++met;
    }
    EXPECT_EQ(nearest[i].face, detector.closest_point(0, points[i]).face);
    EXPECT_EQ(sides[i], detector.point_side(0, points[i]));
    inside += sides[i] == Point_side::inside ? 1 : 0;
  }
  EXPECT_GT(met, 5U);
  EXPECT_GT(inside, 0U);
  EXPECT_TRUE(detector.first_hits(0, {}).empty());
  EXPECT_THROW(detector.closest_points(1, points), Bad_argument);
}

}  // namespace
}  // namespace lodestone
