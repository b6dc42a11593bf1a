// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/shapes/shapes.h"

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/boost/graph/helpers.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "lodestone/mesh/errors.h"
#include "support/special_numbers.h"

namespace lodestone {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using std::numbers::pi;

long euler_characteristic(const Surface_mesh& mesh) {
  return long(mesh.number_of_vertices()) - long(mesh.number_of_edges()) + long(mesh.number_of_faces());
}

/// Signed volume between the faces of `mesh` for which `counts` holds and `apex`: positive if they face away from it.
template <class Counts>
double volume(const Surface_mesh& mesh, const Point& apex, Counts counts) {
  double sum = 0;
  for (const auto f : mesh.faces()) {
    if (!counts(f)) continue;
    const auto h = mesh.halfedge(f);
    sum += CGAL::volume(apex, mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                        mesh.point(mesh.target(mesh.next(h))));
  }
  return sum;
}

double volume(const Surface_mesh& mesh) {
  return volume(mesh, Point(0, 0, 0), [](auto) { return true; });
}

double area(const Surface_mesh& mesh) {
  double sum = 0;
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    sum += std::sqrt(CGAL::squared_area(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                                        mesh.point(mesh.target(mesh.next(h)))));
  }
  return sum;
}

double greatest_distance_from_unit_sphere(const Surface_mesh& mesh) {
  double greatest = 0;
  for (const auto v : mesh.vertices())
    greatest = std::max(greatest, std::abs(std::sqrt((mesh.point(v) - CGAL::ORIGIN).squared_length()) - 1));
  return greatest;
}

std::size_t number_of_borders(const Surface_mesh& mesh) {
  std::vector<Surface_mesh::Halfedge_index> cycles;
  PMP::extract_boundary_cycles(mesh, std::back_inserter(cycles));
  return cycles.size();
}

std::string refusal_of(std::string_view patches) {
  try {
    bezier_patches(patches, "test.bpt", {1, 1});
  } catch (const Bad_mesh& error) {
    return error.what();
  }
  return "no error";
}

// ---- Teapot ----

class Teapot_grids : public testing::TestWithParam<Patch_grid> {};

TEST_P(Teapot_grids, give_64uv_minus_8v_triangles_in_four_components_without_cracks) {
  const auto [u, v] = GetParam();
  Surface_mesh mesh = teapot({.u = u, .v = v});
  EXPECT_EQ(mesh.number_of_faces(), 64 * u * v - 8 * v);
  const auto component = mesh.add_property_map<Surface_mesh::Face_index, std::size_t>("component").first;
  EXPECT_EQ(PMP::connected_components(mesh, component), 4U);
  // Body and lid have one border each, handle and spout two. A crack would add a border.
  EXPECT_EQ(number_of_borders(mesh), 6U);
  // Two discs and two open tubes.
  EXPECT_EQ(euler_characteristic(mesh), 2);
  EXPECT_TRUE(mesh.is_valid());
}

INSTANTIATE_TEST_SUITE_P(Shapes, Teapot_grids,
                         testing::Values(Patch_grid{1, 2}, Patch_grid{2, 3}, Patch_grid{3, 2}, Patch_grid{9, 10},
                                         Patch_grid{10, 9}, Patch_grid{7, 7}, Patch_grid{10, 10}, Patch_grid{1, 13}));

TEST(Teapot, every_component_faces_outward) {
  Surface_mesh mesh = teapot();
  const auto component = mesh.add_property_map<Surface_mesh::Face_index, std::size_t>("component").first;
  const std::size_t pieces = PMP::connected_components(mesh, component);
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    const auto is_in_piece = [&](auto f) { return component[f] == piece; };
    CGAL::Bbox_3 box;
    for (const auto f : mesh.faces())
      if (is_in_piece(f))
        for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) box += mesh.point(v).bbox();
    const Point middle((box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2, (box.zmin() + box.zmax()) / 2);
    EXPECT_GT(volume(mesh, middle, is_in_piece), 0) << "piece " << piece;
  }
}

TEST(Teapot, has_newell_s_size) {
  CGAL::Bbox_3 box;
  const Surface_mesh mesh = teapot({.u = 6, .v = 6});
  for (const auto v : mesh.vertices()) box += mesh.point(v).bbox();
  // From Newell's control points: the lid's knob at z = 3.15, the spout's lip, the handle's back.
  EXPECT_DOUBLE_EQ(box.zmin(), 0);
  EXPECT_DOUBLE_EQ(box.zmax(), 3.15);
  EXPECT_NEAR(box.xmax() - box.xmin(), 6.43, 0.05);
}

TEST(Teapot, refuses_empty_and_enormous_grids) {
  EXPECT_THROW(teapot({.u = 0, .v = 1}), Bad_argument);
  EXPECT_THROW(teapot({.u = 1, .v = 0}), Bad_argument);
  EXPECT_THROW(teapot({.u = std::numeric_limits<std::size_t>::max(), .v = 2}), Bad_argument);
}

// ---- Bezier patches ----

/// One flat patch over [0, 3]^2.
const std::string flat_patch =
    "1 16\n0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15\n"
    "0 0 0\n0 1 0\n0 2 0\n0 3 0\n1 0 0\n1 1 0\n1 2 0\n1 3 0\n"
    "2 0 0\n2 1 0\n2 2 0\n2 3 0\n3 0 0\n3 1 0\n3 2 0\n3 3 0\n";

TEST(Bezier_patches, with_evenly_spaced_control_points_give_a_flat_square) {
  const Surface_mesh mesh = bezier_patches(flat_patch, "flat", {4, 5});
  EXPECT_EQ(mesh.number_of_faces(), 40U);
  EXPECT_NEAR(area(mesh), 9, 1e-12);
  // Along a row is y, from row to row is x: y cross x points down, which is outside.
  EXPECT_NEAR(volume(mesh, Point(0, 0, 1), [](auto) { return true; }), 3, 1e-12);
}

TEST(Bezier_patches, with_opposite_orientations_are_made_consistent) {
  // The second patch shares the first row of the flat one, named in the same direction: it lies on the other side of
  // it.
  std::string text = flat_patch;
  text.replace(0, 5, "2 28\n0 1 2 3 16 17 18 19 20 21 22 23 24 25 26 27\n");
  for (int i = 1; i <= 3; ++i)
    for (int j = 0; j <= 3; ++j) text += std::to_string(-i) + " " + std::to_string(j) + " 0\n";
  const Surface_mesh mesh = bezier_patches(text, "two", {3, 2});
  EXPECT_EQ(mesh.number_of_faces(), 24U);
  EXPECT_EQ(number_of_borders(mesh), 1U);
  EXPECT_EQ(euler_characteristic(mesh), 1);
  EXPECT_NEAR(std::abs(volume(mesh, Point(0, 0, 1), [](auto) { return true; })), 6, 1e-12);
}

TEST(Bezier_patches, name_the_line_of_a_broken_number) {
  std::string text = flat_patch;
  text.replace(text.find("2 2 0"), 5, "2 x 0");
  EXPECT_EQ(refusal_of(text), "test.bpt:13: expected a coordinate");
}

TEST(Bezier_patches, refuse_a_point_index_out_of_range) {
  std::string text = flat_patch;
  text.replace(text.find(" 15\n"), 3, " 16");
  EXPECT_EQ(refusal_of(text), "test.bpt:2: patch refers to point 16 of 16");
}

TEST(Bezier_patches, refuse_negative_point_indices) {
  std::string text = flat_patch;
  text.replace(text.find(" 15\n"), 3, " -1");
  EXPECT_EQ(refusal_of(text), "test.bpt:2: expected a point number");
}

TEST(Bezier_patches, refuse_truncated_text) {
  EXPECT_EQ(refusal_of(flat_patch.substr(0, flat_patch.size() - 4)), "test.bpt:18: expected a coordinate");
  EXPECT_EQ(refusal_of(""), "test.bpt:1: expected the number of patches");
}

TEST(Bezier_patches, refuse_text_after_the_last_point) {
  EXPECT_EQ(refusal_of(flat_patch + "7\n"), "test.bpt:19: expected the end after the last point");
}

TEST(Bezier_patches, refuse_counts_too_large_for_the_text) {
  EXPECT_EQ(refusal_of("4000000000 1\n0 1 2\n0 1 2\n"),
            "test.bpt:1: announces 4000000000 patches and 1 points, more than the text can hold");
  EXPECT_EQ(refusal_of("1 4000000000\n0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n"),
            "test.bpt:1: announces 1 patches and 4000000000 points, more than the text can hold");
  EXPECT_EQ(refusal_of("99999999999999999999999 16\n"), "test.bpt:1: expected the number of patches");
}

TEST(Bezier_patches, refuse_non_finite_and_enormous_coordinates) {
  for (const std::string bad : {"inf", "nan", "1e200"}) {
    std::string text = flat_patch;
    text.replace(text.find("3 3 0"), 1, bad);
    EXPECT_EQ(refusal_of(text),
              "test.bpt:18: coordinate " + (bad == "1e200" ? "1e+200" : bad) + " is not between -1e100 and 1e100");
  }
}

TEST(Bezier_patches, refuse_text_whose_patches_all_have_no_area) {
  EXPECT_EQ(refusal_of("1 1\n0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n1 2 3\n"), "test.bpt: every patch is a point or a line");
}

// ---- Spheres ----

TEST(Uv_sphere, of_the_paper_s_experiment_has_1260_triangles) { EXPECT_EQ(uv_sphere(30, 22).number_of_faces(), 1260U); }

TEST(Uv_sphere, is_watertight_faces_outward_and_has_radius_one) {
  for (const auto& [slices, stacks] : std::vector<std::pair<std::size_t, std::size_t>>{{3, 2}, {5, 3}, {30, 22}}) {
    const Surface_mesh mesh = uv_sphere(slices, stacks);
    EXPECT_EQ(mesh.number_of_faces(), 2 * slices * (stacks - 1));
    EXPECT_TRUE(CGAL::is_closed(mesh));
    EXPECT_EQ(euler_characteristic(mesh), 2);
    EXPECT_LT(greatest_distance_from_unit_sphere(mesh), 1e-15);
    EXPECT_GT(volume(mesh), 0);
  }
  EXPECT_NEAR(volume(uv_sphere(200, 200)), 4 * pi / 3, 2e-3);
}

TEST(Icosphere, is_watertight_faces_outward_and_has_radius_one) {
  for (const std::size_t frequency : {1, 2, 3, 7, 16}) {
    const Surface_mesh mesh = icosphere(frequency);
    EXPECT_EQ(mesh.number_of_faces(), 20 * frequency * frequency);
    EXPECT_EQ(mesh.number_of_vertices(), 10 * frequency * frequency + 2);
    EXPECT_TRUE(CGAL::is_closed(mesh));
    EXPECT_LT(greatest_distance_from_unit_sphere(mesh), 1e-15);
  }
}

TEST(Icosphere, of_frequency_one_is_the_regular_icosahedron_and_finer_ones_approach_the_ball) {
  const double edge = 1 / std::sin(2 * pi / 5);
  EXPECT_NEAR(volume(icosphere(1)), 5 * (3 + std::sqrt(5.0)) / 12 * std::pow(edge, 3), 1e-14);
  EXPECT_NEAR(volume(icosphere(60)), 4 * pi / 3, 2e-3);
}

// ---- Knots and cloth ----

TEST(Torus_knot, is_a_closed_tube_that_faces_outward) {
  for (const Torus_knot_options& knot : {Torus_knot_options{}, Torus_knot_options{.p = 3, .q = 4, .tube = 0.1},
                                         Torus_knot_options{.p = 1, .q = 0, .segments = 3, .sides = 3}}) {
    const Surface_mesh mesh = torus_knot(knot);
    EXPECT_EQ(mesh.number_of_faces(), 2 * knot.segments * knot.sides);
    EXPECT_TRUE(CGAL::is_closed(mesh));
    EXPECT_EQ(euler_characteristic(mesh), 0);
    EXPECT_GT(volume(mesh), 0);
  }
}

TEST(Torus_knot, with_p_1_and_q_0_is_the_torus) {
  // The knot is then the circle of radius R = 3/2 radius; Pappus: area 4 pi^2 R r, volume 2 pi^2 R r^2.
  const Surface_mesh mesh = torus_knot({.p = 1, .q = 0, .radius = 2, .tube = 0.5, .segments = 300, .sides = 200});
  EXPECT_NEAR(area(mesh), 4 * pi * pi * 3 * 0.5, 0.02);
  EXPECT_NEAR(volume(mesh), 2 * pi * pi * 3 * 0.25, 0.01);
}

TEST(Cloth, is_the_unit_square_facing_up) {
  const Surface_mesh mesh = cloth(4, 3);
  EXPECT_EQ(mesh.number_of_faces(), 24U);
  EXPECT_EQ(mesh.number_of_vertices(), 20U);
  EXPECT_EQ(number_of_borders(mesh), 1U);
  EXPECT_EQ(euler_characteristic(mesh), 1);
  EXPECT_NEAR(area(mesh), 1, 1e-15);
  // The pyramid over the unit square with height 1, seen from below.
  EXPECT_NEAR(volume(mesh, Point(0, 0, -1), [](auto) { return true; }), 1.0 / 3, 1e-15);
}

TEST(Shapes, refuse_counts_below_the_minimum) {
  EXPECT_THROW(uv_sphere(2, 5), Bad_argument);
  EXPECT_THROW(uv_sphere(3, 1), Bad_argument);
  EXPECT_THROW(icosphere(0), Bad_argument);
  EXPECT_THROW(cloth(0, 1), Bad_argument);
  EXPECT_THROW(cloth(1, 0), Bad_argument);
  EXPECT_THROW(torus_knot({.p = 0, .q = 1}), Bad_argument);
  EXPECT_THROW(torus_knot({.segments = 2}), Bad_argument);
  EXPECT_THROW(torus_knot({.sides = 2}), Bad_argument);
}

TEST(Shapes, refuse_more_than_the_face_limit_before_they_build) {
  constexpr std::size_t huge = std::numeric_limits<std::size_t>::max();
  EXPECT_THROW(uv_sphere(huge, huge), Bad_argument);
  EXPECT_THROW(uv_sphere(5001, 5001), Bad_argument);
  EXPECT_THROW(icosphere(huge), Bad_argument);
  EXPECT_THROW(cloth(huge, 1), Bad_argument);
  EXPECT_THROW(torus_knot({.segments = huge, .sides = 3}), Bad_argument);
}

TEST(Torus_knot, refuses_common_divisors_and_lengths_that_are_not_positive) {
  EXPECT_THROW(torus_knot({.p = 2, .q = 4}), Bad_argument);
  EXPECT_THROW(torus_knot({.p = 2, .q = 0}), Bad_argument);
  EXPECT_THROW(torus_knot({.radius = 0}), Bad_argument);
  EXPECT_THROW(torus_knot({.tube = -1}), Bad_argument);
  EXPECT_THROW(torus_knot({.tube = infinity}), Bad_argument);
  EXPECT_THROW(torus_knot({.radius = std::nan("")}), Bad_argument);
}

}  // namespace
}  // namespace lodestone
