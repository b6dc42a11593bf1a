// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/triangles/ray_crossing.h"

#include <CGAL/Side_of_triangle_mesh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>

#include "lodestone/io/shapes/shapes.h"
#include "lodestone/mesh/is_closed.h"
#include "support/face_soup.h"
#include "support/test_meshes.h"
#include "support/touching_triangles.h"

namespace lodestone {
namespace {

/// Adds a vertex; gives its index.
std::uint32_t add(Face_soup& soup, const Point& p) {
  soup.coordinates.insert(soup.coordinates.end(), {p.x(), p.y(), p.z()});
  return soup.vertex_count() - 1;
}

Point placed_point(const Point& p, double scale, double offset) {
  return {scale * p.x() + offset, scale * p.y() + offset, scale * p.z() + offset};
}

/// Scales that never round, and an offset that does not round coordinates of few digits.
const std::vector<std::pair<double, double>> places{{1, 0},        {0x1p-300, 0}, {0x1p300, 0}, {0x1p-1060, 0},
                                                    {0x1p1010, 0}, {1, 0x1p20},   {1, -0x1p20}};

/// Whether a point is inside a closed mesh, by the parity of all faces. On the surface either answer is right.
bool inside(const Face_soup& soup, const Point& p, double scale = 1, double offset = 0) {
  const Face_soup there = placed(soup, scale, offset);
  const std::span<const double> coordinates(there.coordinates);
  const auto position = [&](std::uint32_t vertex) { return coordinates.subspan(3 * std::size_t{vertex}, 3); };
  bool inside = false;
  for (const auto& face : there.faces)
    inside ^= crosses_upward_ray(face_triangle(face, position), placed_point(p, scale, offset));
  return inside;
}

/// Points that share coordinates with vertices, lie above them, above edges and anywhere.
std::vector<Point> awkward_points(const Surface_mesh& mesh, std::mt19937_64& random, int count) {
  const auto vertex = [&] { return mesh.point(Surface_mesh::Vertex_index(random() % mesh.number_of_vertices())); };
  const auto somewhere = [&] { return std::uniform_real_distribution<double>(-2, 2)(random); };
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) {
    const auto edge = mesh.halfedge(Surface_mesh::Edge_index(random() % mesh.number_of_edges()));
    const auto middle = CGAL::midpoint(mesh.point(source(edge, mesh)), mesh.point(target(edge, mesh)));
    points.emplace_back(vertex().x(), vertex().y(), somewhere());
    points.emplace_back(vertex().x(), somewhere(), vertex().z());
    const auto v = vertex();
    points.emplace_back(v.x(), v.y(), somewhere());
    points.emplace_back(middle.x(), middle.y(), somewhere());
    points.emplace_back(somewhere(), somewhere(), somewhere());
  }
  return points;
}

void expect_equal_to_cgal(const Surface_mesh& mesh, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const Face_soup soup(mesh);
  EXPECT_TRUE(is_closed(soup.vertex_count(), soup.faces));
  const CGAL::Side_of_triangle_mesh<Surface_mesh, Kernel> side(mesh);
  std::size_t within = 0, beyond = 0;
  for (const auto& p : awkward_points(mesh, random, 150)) {
    const auto expected = side(p);
    if (expected == CGAL::ON_BOUNDARY) continue;
    ++(expected == CGAL::ON_BOUNDED_SIDE ? within : beyond);
    for (const double scale : {1.0, 0x1p-300, 0x1p300})
      ASSERT_EQ(inside(soup, p, scale), expected == CGAL::ON_BOUNDED_SIDE) << p << " at " << scale;
  }
  EXPECT_GT(within, 20U);
  EXPECT_GT(beyond, 20U);
}

TEST(Point_inside, equals_cgal_on_a_sphere) { expect_equal_to_cgal(sphere(8), 1); }

TEST(Point_inside, equals_cgal_on_a_torus_knot) {
  auto knot = torus_knot({.tube = 0.25, .segments = 60, .sides = 8});
  expect_equal_to_cgal(knot, 2);
}

TEST(Point_inside, equals_cgal_far_from_the_origin) {
  auto mesh = potato(6);
  shift(mesh, 0x1p20, -0x1p20, 0x1p20);
  std::mt19937_64 random(3);
  const Face_soup soup(mesh);
  const CGAL::Side_of_triangle_mesh<Surface_mesh, Kernel> side(mesh);
  std::size_t within = 0;
  for (auto p : awkward_points(potato(6), random, 100)) {
    p = Point(p.x() + 0x1p20, p.y() - 0x1p20, p.z() + 0x1p20);
    const auto expected = side(p);
    if (expected == CGAL::ON_BOUNDARY) continue;
    within += expected == CGAL::ON_BOUNDED_SIDE ? 1 : 0;
    ASSERT_EQ(inside(soup, p), expected == CGAL::ON_BOUNDED_SIDE) << p;
  }
  EXPECT_GT(within, 50U);
}

TEST(Point_inside, equals_cgal_on_several_components_and_on_nested_shells) {
  auto apart = sphere(5, 0.7, {-1, 0, 0});
  append(apart, sphere(5, 0.7, {1, 0, 0}));
  expect_equal_to_cgal(apart, 4);
  auto nested = sphere(6, 1.5);
  append(nested, sphere(6, 1));
  append(nested, cube(2));
  expect_equal_to_cgal(nested, 5);
}

TEST(Point_inside, is_right_for_points_on_the_lattice_of_a_cube) {
  const Face_soup soup(cube(4));
  for (int i = -1; i <= 9; ++i)
    for (int j = -1; j <= 9; ++j)
      for (int k = -1; k <= 9; ++k) {
        const bool within = std::min({i, j, k}) > 0 && std::max({i, j, k}) < 8;
        const bool beyond = std::min({i, j, k}) < 0 || std::max({i, j, k}) > 8;
        if (!within && !beyond) continue;
        for (const auto& [scale, offset] : places)
          ASSERT_EQ(inside(soup, {i / 8.0, j / 8.0, k / 8.0}, scale, offset), within) << i << ' ' << j << ' ' << k;
      }
}

TEST(Point_inside, is_right_for_points_on_the_lattice_of_an_octahedron) {
  const auto lattice = [](const std::array<int, 3>& p) { return Point(p[0], p[1], p[2]); };
  for (const int parts : {1, 3}) {
    const Face_soup soup(octahedral(parts, lattice));
    for (int i = -8; i <= 8; ++i)
      for (int j = -8; j <= 8; ++j)
        for (int k = -8; k <= 8; ++k) {
          const int level = std::abs(i) + std::abs(j) + std::abs(k);
          if (level == 2 * parts) continue;
          for (const auto& [scale, offset] : places)
            ASSERT_EQ(inside(soup, {i / 2.0, j / 2.0, k / 2.0}, scale, offset), level < 2 * parts)
                << i << ' ' << j << ' ' << k << " of " << parts;
        }
  }
}

/// A cube with zero-area faces: some closed in themselves, and one that fills the slit between an edge and its two
/// halves.
Face_soup cube_with_degenerate_faces() {
  Face_soup soup(cube(2));
  const auto first = soup.faces.front();
  const auto halved = std::ranges::find_if(soup.faces, [&](const Corners& face) {
    const Point p = soup.point(face[0]), q = soup.point(face[1]);
    return p.x() != q.x() && p.y() == q.y() && p.z() == q.z();
  });
  const auto [a, b, c] = *halved;
  const auto middle = add(soup, CGAL::midpoint(soup.point(a), soup.point(b)));
  *halved = {a, middle, c};
  soup.faces.insert(soup.faces.end(), {{middle, b, c}, {a, b, middle}});
  soup.faces.insert(soup.faces.end(), {{a, a, c}, {b, b, b}, {c, a, c}, first, first});
  const auto on_top = add(soup, soup.point(c));
  soup.faces.insert(soup.faces.end(), {{a, c, on_top}, {c, on_top, a}});
  return soup;
}

TEST(Point_inside, is_right_in_a_cube_with_zero_area_faces) {
  const Face_soup soup = cube_with_degenerate_faces();
  EXPECT_TRUE(is_closed(soup.vertex_count(), soup.faces));
  for (int i = -1; i <= 9; ++i)
    for (int j = -1; j <= 9; ++j)
      for (int k = -1; k <= 9; ++k) {
        const bool within = std::min({i, j, k}) > 0 && std::max({i, j, k}) < 8;
        const bool beyond = std::min({i, j, k}) < 0 || std::max({i, j, k}) > 8;
        if (!within && !beyond) continue;
        ASSERT_EQ(inside(soup, {i / 8.0, j / 8.0, k / 8.0}), within) << i << ' ' << j << ' ' << k;
      }
}

Wide_vector wide(const Integer_point& p) { return {p[0], p[1], p[2]}; }

TEST(Point_inside, counts_modulo_two_the_lattice_tetrahedra_that_contain_the_point) {
  std::mt19937_64 random(6);
  std::size_t within = 0, checked = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const int size = 4 + trial % 6;
    Face_soup soup;
    bool expected = false, on_surface = false;
    Integer_point p = random_triangle(random, (size + 1) / 2)[0];
    for (auto& x : p) x += size / 4;
    for (int solid = 0; solid < 3; ++solid) {
      std::array<Integer_point, 4> corner{};
      for (auto& c : corner) c = random_triangle(random, size)[0];
      const auto from_p = [&](int i) { return minus(wide(corner[i]), wide(p)); };
      expected ^= origin_in(from_p(0), from_p(1), from_p(2), from_p(3));
      std::array<std::uint32_t, 4> v{};
      for (int i = 0; i < 4; ++i) v[i] = add(soup, as_triangle({corner[i], corner[i], corner[i]})[0]);
      for (int i = 0; i < 4; ++i) {
        const int j = (i + 1) % 4, k = (i + 2) % 4;
        soup.faces.push_back({v[i], v[j], v[k]});
        on_surface |= have_common_point({p, p, p}, {corner[i], corner[j], corner[k]});
      }
    }
    ASSERT_TRUE(is_closed(soup.vertex_count(), soup.faces));
    if (on_surface) continue;
    ++checked;
    within += expected ? 1 : 0;
    ASSERT_EQ(inside(soup, as_triangle({p, p, p})[0]), expected);
  }
  EXPECT_GT(checked, 10000U);
  EXPECT_GT(within, 1000U);
}

TEST(Crosses_upward_ray, counts_a_triangle_only_above_the_point) {
  const Triangle t = as_triangle({{{0, 0, 2}, {4, 0, 2}, {0, 4, 6}}});
  const Triangle turned{t[0], t[2], t[1]};
  for (const auto& triangle : {t, turned}) {
    EXPECT_TRUE(crosses_upward_ray(triangle, {1, 1, 0}));
    EXPECT_TRUE(crosses_upward_ray(triangle, {1, 1, std::nextafter(3.0, 0.0)}));
    EXPECT_FALSE(crosses_upward_ray(triangle, {1, 1, std::nextafter(3.0, 9.0)}));
    EXPECT_FALSE(crosses_upward_ray(triangle, {3, 3, 0}));
    EXPECT_FALSE(crosses_upward_ray(triangle, {-1, 1, 0}));
  }
}

TEST(Crosses_upward_ray, decides_ties_as_for_a_point_a_little_to_the_right_and_less_above) {
  const Triangle lower_left = as_triangle({{{0, 0, 2}, {4, 0, 2}, {0, 4, 2}}});
  EXPECT_TRUE(crosses_upward_ray(lower_left, {0, 0, 0}));
  EXPECT_TRUE(crosses_upward_ray(lower_left, {0, 1, 0}));
  EXPECT_TRUE(crosses_upward_ray(lower_left, {1, 0, 0}));
  EXPECT_FALSE(crosses_upward_ray(lower_left, {2, 2, 0}));
  EXPECT_FALSE(crosses_upward_ray(lower_left, {4, 0, 0}));
  EXPECT_FALSE(crosses_upward_ray(lower_left, {0, 4, 0}));
  const Triangle upper_right = as_triangle({{{4, 4, 2}, {0, 4, 2}, {4, 0, 2}}});
  EXPECT_TRUE(crosses_upward_ray(upper_right, {2, 2, 0}));
  EXPECT_FALSE(crosses_upward_ray(upper_right, {4, 1, 0}));
  EXPECT_FALSE(crosses_upward_ray(upper_right, {1, 4, 0}));
  EXPECT_FALSE(crosses_upward_ray(upper_right, {0, 4, 0}));
  const Triangle steep = as_triangle({{{0, 0, 2}, {1, 4, 2}, {-1, 4, 2}}});
  EXPECT_FALSE(crosses_upward_ray(steep, {0, 0, 0}));  // to the right of it: e^2 is less than 4 e
}

TEST(Crosses_upward_ray, counts_one_face_around_a_vertex_and_one_of_two_at_an_edge) {
  const Surface_mesh flat = grid(7, 7);
  for (int i = 1; i < 24; ++i)
    for (int j = 1; j < 24; ++j) {
      int count = 0;
      for (const auto f : flat.faces()) {
        const auto h = flat.halfedge(f);
        const Triangle t{flat.point(flat.source(h)), flat.point(flat.target(h)), flat.point(flat.target(flat.next(h)))};
        count += crosses_upward_ray(t, {i / 4.0, j / 4.0, -1}) ? 1 : 0;
      }
      ASSERT_EQ(count, 1) << i << ' ' << j;
    }
}

TEST(Crosses_upward_ray, never_counts_a_vertical_or_zero_area_triangle) {
  for (const auto& t :
       {Integer_triangle{{{0, 0, 1}, {4, 0, 1}, {2, 0, 5}}}, Integer_triangle{{{0, 0, 1}, {2, 2, 1}, {4, 4, 9}}},
        Integer_triangle{{{0, 0, 1}, {2, 2, 2}, {4, 4, 3}}}, Integer_triangle{{{2, 0, 1}, {2, 0, 1}, {2, 0, 3}}},
        Integer_triangle{{{2, 2, 1}, {2, 2, 1}, {2, 2, 1}}}})
    for (int x = 0; x <= 8; ++x)
      for (int y = 0; y <= 8; ++y) EXPECT_FALSE(crosses_upward_ray(as_triangle(t), {x / 2.0, y / 2.0, 0})) << text(t);
}

TEST(Is_closed, is_true_if_every_edge_is_in_an_even_number_of_faces) {
  EXPECT_TRUE(is_closed(0, {}));
  const std::vector<Corners> twice{{0, 1, 2}, {0, 2, 1}};
  EXPECT_TRUE(is_closed(3, twice));
  const std::vector<Corners> hinge{{0, 1, 2}, {1, 0, 3}};
  EXPECT_FALSE(is_closed(4, hinge));
  const std::vector<Corners> tetrahedra_at_an_edge{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3},
                                                   {0, 1, 4}, {0, 1, 5}, {0, 4, 5}, {1, 4, 5}};
  EXPECT_TRUE(is_closed(6, tetrahedra_at_an_edge));
  auto fin = tetrahedra_at_an_edge;
  fin.push_back({0, 1, 6});
  EXPECT_FALSE(is_closed(7, fin));
}

TEST(Is_closed, ignores_faces_with_a_repeated_vertex) {
  const std::vector<Corners> alone{{0, 0, 1}, {2, 1, 2}, {3, 4, 4}, {5, 5, 5}};
  EXPECT_TRUE(is_closed(6, alone));
  const std::vector<Corners> with_a_face{{0, 1, 2}, {0, 0, 1}, {1, 2, 2}, {0, 2, 0}};
  EXPECT_FALSE(is_closed(3, with_a_face));
}

TEST(Is_closed, is_false_for_a_mesh_without_one_of_its_faces) {
  const Face_soup soup(potato(4));
  EXPECT_TRUE(is_closed(soup.vertex_count(), soup.faces));
  for (std::size_t missing = 0; missing < soup.faces.size(); ++missing) {
    auto faces = soup.faces;
    faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(missing));
    EXPECT_FALSE(is_closed(soup.vertex_count(), faces));
  }
  const Numbered_mesh flat(grid(4, 4));
  EXPECT_FALSE(is_closed(flat.numbering.vertex_count(), flat.faces));
}

}  // namespace
}  // namespace lodestone
