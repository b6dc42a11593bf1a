// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/region_count.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>

#include "lodestone/mesh/errors.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

using Labels = std::vector<Region_index>;

Region_adjustment adjust(const Surface_mesh& mesh, Labels& labels, std::size_t wanted) {
  const Numbered_mesh numbered(mesh);
  return adjust_region_count(numbered.graph, numbered.positions, labels, wanted);
}

/// Sizes of the regions; each must be one piece.
std::vector<std::size_t> connected_sizes(const Surface_mesh& mesh, const Labels& labels, std::size_t regions) {
  std::vector<std::size_t> sizes;
  for (const auto& pieces : pieces_of(Numbered_mesh(mesh).graph, labels, regions)) {
    EXPECT_EQ(pieces.size(), 1U);
    sizes.push_back(pieces.empty() ? 0 : pieces.front());
  }
  return sizes;
}

TEST(Region_count, one_region_is_split_into_any_number_of_connected_regions) {
  for (const auto& mesh : {sphere(6), potato(7), grid(20, 3), cube(4)})
    for (const std::size_t wanted : {1, 2, 3, 7, 12, 50}) {
      Labels labels(mesh.number_of_vertices(), 0);
      const auto result = adjust(mesh, labels, wanted);
      EXPECT_EQ(result.regions, wanted);
      EXPECT_EQ(result.split, wanted - 1);
      EXPECT_EQ(result.joined, 0U);
      const auto sizes = connected_sizes(mesh, labels, wanted);
      EXPECT_GE(std::ranges::min(sizes), 1U);
    }
}

TEST(Region_count, a_strip_is_cut_in_the_middle_of_its_length) {
  const auto mesh = grid(16, 3);
  Labels labels(48, 0);
  adjust(mesh, labels, 4);
  for (std::uint32_t v = 0; v < 48; ++v) EXPECT_EQ(labels[v], labels[v % 16 / 4 * 4]) << v;
  EXPECT_EQ(std::set<Region_index>(labels.begin(), labels.end()).size(), 4U);
}

TEST(Region_count, a_strip_is_cut_across_whichever_way_it_lies) {
  const auto along_x = grid(16, 3);
  Labels expected(48, 0);
  adjust(along_x, expected, 2);
  for (const auto& [x, y, z] : {std::array{1, 0, 2}, std::array{2, 1, 0}}) {
    auto mesh = along_x;
    for (auto& p : mesh.points()) p = {p[x], p[y], p[z]};
    Labels labels(48, 0);
    adjust(mesh, labels, 2);
    for (std::uint32_t v = 0; v < 48; ++v) EXPECT_EQ(labels[v] == labels[0], expected[v] == expected[0]) << v;
  }
}

TEST(Region_count, the_cuts_of_a_strip_do_not_depend_on_its_position) {
  auto mesh = grid(16, 3);
  Labels at_origin(48, 0), elsewhere(48, 0);
  adjust(mesh, at_origin, 7);
  for (const double size : {1e-300, 1e300}) {
    auto other = mesh;
    scale(other, size);
    elsewhere.assign(48, 0);
    adjust(other, elsewhere, 7);
    EXPECT_EQ(elsewhere, at_origin);
  }
  shift(mesh, 1024, -4096, 512);
  elsewhere.assign(48, 0);
  adjust(mesh, elsewhere, 7);
  EXPECT_EQ(elsewhere, at_origin);
}

TEST(Region_count, the_halves_of_a_bent_region_are_connected) {
  // A U of 40 pairs of vertices, its arms along the x axis: a plain median would leave the ends of both in one half.
  std::vector<Point> points;
  for (int i = 0; i < 40; ++i)
    for (const double width : {1.0, 1.2})
      points.emplace_back(10 * width * std::cos(0.08 * i - 1.56), width * std::sin(0.08 * i - 1.56), 0);
  const auto mesh = mesh_of(points, grid_faces(2, 40));
  Labels labels(80, 0);
  EXPECT_EQ(adjust(mesh, labels, 2).regions, 2U);
  EXPECT_EQ(connected_sizes(mesh, labels, 2), (std::vector<std::size_t>{40, 40}));
}

TEST(Region_count, the_largest_region_is_split_first) {
  const auto mesh = grid(12, 4);
  Labels labels(48);
  for (std::uint32_t v = 0; v < 48; ++v) labels[v] = v % 12 < 2 ? 5 : 9;  // 8 and 40 vertices
  EXPECT_EQ(adjust(mesh, labels, 3).regions, 3U);
  auto sizes = connected_sizes(mesh, labels, 3);
  std::ranges::sort(sizes);
  EXPECT_EQ(sizes, (std::vector<std::size_t>{8, 20, 20}));
}

TEST(Region_count, the_smallest_region_joins_the_neighbour_with_the_longest_common_border) {
  // Columns of 1, 3, 4 and 4; in the first row the first column is one vertex longer.
  const auto mesh = grid(12, 4);
  Labels labels(48);
  for (std::uint32_t v = 0; v < 48; ++v) labels[v] = v % 12 < 1 ? 0 : v % 12 < 4 ? 1 : v % 12 < 8 ? 2 : 3;
  const auto result = adjust(mesh, labels, 3);
  EXPECT_EQ(result.joined, 1U);
  EXPECT_EQ(result.regions, 3U);
  for (std::uint32_t v = 0; v < 48; ++v) EXPECT_EQ(labels[v], v % 12 / 4) << v;
}

TEST(Region_count, a_region_between_two_joins_the_one_it_touches_more) {
  // A single vertex in row 0: three edges of its five or six lead to either side or both; counted by hand below.
  const auto mesh = grid(5, 3);
  Labels labels(15, 0);
  for (const std::uint32_t v : {3, 4, 8, 9, 13, 14}) labels[v] = 1;
  labels[7] = 2;  // neighbours 1, 2, 6, 12 of region 0; 8 and 13 of region 1
  EXPECT_EQ(adjust(mesh, labels, 2).joined, 1U);
  EXPECT_EQ(labels[7], 0U);
  labels[7] = 2;
  labels[1] = labels[2] = 1;  // now 6 and 12 against 1, 2, 8 and 13
  EXPECT_EQ(adjust(mesh, labels, 2).joined, 1U);
  EXPECT_EQ(labels[7], 1U);
}

TEST(Region_count, many_regions_are_reduced_to_any_number) {
  const auto mesh = potato(10);
  std::mt19937 random(3);
  for (const std::size_t wanted : {1, 2, 5, 40, 200}) {
    Labels labels(mesh.number_of_vertices());
    for (std::uint32_t v = 0; v < labels.size(); ++v) labels[v] = v;
    std::ranges::shuffle(labels, random);
    const auto result = adjust(mesh, labels, wanted);
    EXPECT_EQ(result.regions, wanted);
    EXPECT_EQ(result.joined, mesh.number_of_vertices() - wanted);
    EXPECT_EQ(connected_sizes(mesh, labels, wanted).size(), wanted);
  }
}

TEST(Region_count, different_components_never_join) {
  Surface_mesh mesh;
  for (int i = 0; i < 4; ++i) append(mesh, sphere(2 + i, 0.3, {1.0 * i, 0, 0}));
  Labels labels(mesh.number_of_vertices());
  for (std::uint32_t v = 0; v < labels.size(); ++v) labels[v] = v;
  EXPECT_EQ(adjust(mesh, labels, 2).regions, 4U);
  EXPECT_EQ(connected_sizes(mesh, labels, 4).size(), 4U);
}

TEST(Region_count, a_region_in_several_pieces_keeps_only_the_largest) {
  Surface_mesh mesh = sphere(3, 1, {0, 0, 0});  // 38 vertices
  append(mesh, sphere(5, 1, {5, 0, 0}));        // 102 vertices
  Labels labels(mesh.number_of_vertices(), 0);
  EXPECT_EQ(adjust(mesh, labels, 2).regions, 2U);
  for (std::uint32_t v = 0; v < labels.size(); ++v) EXPECT_EQ(labels[v], v < 38 ? 0U : 1U);
}

/// Pieces of the vertices of one label, by repeated search.
std::vector<std::vector<std::uint32_t>> pieces_of_label(const Vertex_graph& graph, const Labels& labels,
                                                        Region_index label) {
  std::vector<std::vector<std::uint32_t>> pieces;
  std::vector<bool> seen(labels.size(), false);
  for (std::uint32_t start = 0; start < labels.size(); ++start) {
    if (labels[start] != label || seen[start]) continue;
    std::vector<std::uint32_t> piece{start};
    seen[start] = true;
    for (std::size_t i = 0; i < piece.size(); ++i)
      for (const auto w : neighbours(graph, piece[i]))
        if (labels[w] == label && !seen[w]) {
          seen[w] = true;
          piece.push_back(w);
        }
    pieces.push_back(piece);
  }
  return pieces;
}

/// One cut after the other, each with a new search for the pieces of the largest region. It must have several.
void split_by_searches(const Vertex_graph& graph, Labels& labels, std::size_t regions, std::size_t wanted) {
  for (; regions < wanted; ++regions) {
    std::vector<std::size_t> sizes(regions, 0);
    for (const auto label : labels) ++sizes[label];
    const auto largest = static_cast<Region_index>(std::ranges::max_element(sizes) - sizes.begin());
    const auto pieces = pieces_of_label(graph, labels, largest);
    ASSERT_GT(pieces.size(), 1U);
    const auto side = std::ranges::max_element(pieces, {}, [](const auto& piece) { return piece.size(); });
    // The lowest vertex stays.
    for (const auto& piece : pieces)
      if ((&piece == &*side) != (side == pieces.begin()))
        for (const auto v : piece) labels[v] = static_cast<Region_index>(regions);
  }
}

TEST(Region_count, pieces_leave_a_region_in_the_order_of_repeated_searches) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 20; ++trial) {
    Surface_mesh mesh;
    for (int part = 0; part < 40; ++part)
      append(mesh, grid(2 + static_cast<std::uint32_t>(random() % 4), 2 + static_cast<std::uint32_t>(random() % 3)));
    const std::size_t regions = 1 + random() % 3;
    // Whole components have one label, so the largest region has several pieces for a while.
    const Numbered_mesh numbered(mesh);
    Labels labels(mesh.number_of_vertices(), 0);
    for (std::uint32_t v = 1; v < labels.size(); ++v) {
      const bool begins = std::ranges::none_of(neighbours(numbered.graph, v), [&](auto w) { return w < v; });
      labels[v] =
          begins ? static_cast<Region_index>(random() % regions) : labels[*neighbours(numbered.graph, v).begin()];
    }
    for (Region_index region = 0; region < regions; ++region)
      ASSERT_NE(std::ranges::find(labels, region), labels.end());
    Labels expected = labels;
    split_by_searches(numbered.graph, expected, regions, regions + 12);
    adjust(mesh, labels, regions + 12);
    EXPECT_EQ(labels, expected);
  }
}

TEST(Region_count, a_label_of_very_many_pieces_is_divided_into_them) {
  constexpr std::uint32_t pieces = 100000;
  std::vector<Corners> faces;
  for (std::uint32_t f = 0; f < pieces; ++f) faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  const Positions positions = Positions::Random(3 * pieces, 3);
  Labels labels(3 * pieces, 0);
  const auto result = adjust_region_count(vertex_graph(3 * pieces, faces), positions, labels, pieces);
  EXPECT_EQ(result.regions, pieces);
  EXPECT_EQ(result.split, pieces - 1);
  const std::set<Region_index> different(labels.begin(), labels.end());
  EXPECT_EQ(different.size(), pieces);
  for (std::uint32_t f = 0; f < pieces; ++f) EXPECT_EQ(labels[3 * f], labels[3 * f + 2]);
}

TEST(Region_count, the_largest_of_very_many_components_keep_regions_and_the_others_join_the_nearest) {
  // In a row: 100 strips of three squares, with three loose triangles between each and the next. Far away, a vertex
  // without faces.
  std::vector<Corners> faces;
  std::vector<Eigen::RowVector3d> points;
  Labels labels;
  const auto add = [&](const Surface_mesh& part, double x) {
    const auto first = static_cast<std::uint32_t>(points.size());
    const Numbered_mesh numbered(part);
    for (const auto& [a, b, c] : numbered.faces) faces.push_back({first + a, first + b, first + c});
    for (const auto& row : numbered.positions.rowwise()) {
      points.push_back(row + Eigen::RowVector3d(x, 0, 0));
      labels.push_back(static_cast<Region_index>(labels.size()));
    }
  };
  for (int strip = 0; strip < 100; ++strip) {
    add(grid(4, 2), 100.0 * strip);
    for (const double offset : {-20, -10, 10}) add(single_triangle(), 100.0 * strip + offset);
  }
  points.emplace_back(1e200, 0, 0);
  labels.push_back(static_cast<Region_index>(labels.size()));
  Positions positions(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t v = 0; v < points.size(); ++v) positions.row(static_cast<Eigen::Index>(v)) = points[v];
  const auto graph = vertex_graph(static_cast<std::uint32_t>(points.size()), faces);

  const Labels before = labels;
  const std::size_t wanted = 50;  // at most twice as many, or 64 more
  EXPECT_EQ(adjust_region_count(graph, positions, labels, wanted).regions, 114U);
  labels = before;
  const Region_adjustment adjusted = adjust_region_count(graph, positions, labels, 36);
  EXPECT_EQ(adjusted.regions, 100U);
  EXPECT_EQ(adjusted.joined, 1600U) << "of 1700 vertices with edges";
  for (std::size_t v = 0; v + 1 < labels.size(); ++v)
    EXPECT_EQ(labels[v], labels[v / 17 * 17]) << "each triangle is beside the strip that its group of 17 begins with";
  EXPECT_EQ(std::set<Region_index>(labels.begin(), labels.end()).size(), 100U);
}

TEST(Region_count, there_are_no_more_regions_than_vertices_with_edges) {
  auto mesh = tetrahedron();
  mesh.add_vertex({9, 9, 9});
  Labels labels{0, 0, 0, 0, 7};
  EXPECT_EQ(adjust(mesh, labels, 100).regions, 4U);
  EXPECT_EQ(std::set<Region_index>(labels.begin(), labels.end()), (std::set<Region_index>{0, 1, 2, 3}));
  EXPECT_EQ(labels[4], 0U);
}

TEST(Region_count, with_the_right_number_only_gaps_in_the_labels_are_closed) {
  const auto mesh = grid(4, 2);
  Labels labels{3, 3, 8, 8, 3, 3, 8, 8};
  const auto result = adjust(mesh, labels, 2);
  EXPECT_EQ(labels, (Labels{0, 0, 1, 1, 0, 0, 1, 1}));
  EXPECT_EQ(result.joined + result.split, 0U);
}

TEST(Region_count, a_surface_without_extent_is_split) {
  auto mesh = potato(5);
  deform(mesh, [](const Point&) { return Point(2, 2, 2); });
  Labels labels(mesh.number_of_vertices(), 0);
  EXPECT_EQ(adjust(mesh, labels, 9).regions, 9U);
  connected_sizes(mesh, labels, 9);
}

TEST(Region_count, bad_arguments_are_refused) {
  Labels labels(4, 0), short_labels(3, 0);
  EXPECT_THROW(adjust(tetrahedron(), labels, 0), Bad_argument);
  EXPECT_THROW(adjust(tetrahedron(), short_labels, 2), Bad_argument);
}

}  // namespace
}  // namespace lodestone
