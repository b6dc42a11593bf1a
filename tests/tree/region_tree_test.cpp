// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/tree/region_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>

#include "support/tree_checks.h"

namespace lodestone {
namespace {

using Labels = std::vector<Region_index>;

/// The lowest of the corners' regions.
Region_index region_of(const Corners& corners, const Labels& labels) {
  if (labels.empty()) return 0;
  return std::min({labels[corners[0]], labels[corners[1]], labels[corners[2]]});
}

/// Checks that each leaf is of one region, and that each region has as few leaves as possible, of nearly equal size.
void expect_leaves_of_regions(const Region_tree& tree, const Face_soup& soup, const Labels& labels,
                              std::size_t leaf_faces) {
  std::map<Region_index, std::size_t> faces_of, leaves_of;
  for (const auto& corners : soup.faces) ++faces_of[region_of(corners, labels)];
  for (std::size_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
    const auto faces = tree.faces(leaf);
    const Region_index region = region_of(soup.faces[faces[0]], labels);
    ++leaves_of[region];
    for (const auto face : faces) ASSERT_EQ(region_of(soup.faces[face], labels), region);
    const std::size_t fewest = (faces_of[region] + leaf_faces - 1) / leaf_faces;
    ASSERT_LE(faces.size(), leaf_faces);
    ASSERT_NEAR(faces.size(), static_cast<double>(faces_of[region]) / static_cast<double>(fewest), 1);
    ASSERT_GE(2 * faces.size(), std::min(leaf_faces, 2 * faces_of[region]));
  }
  for (const auto& [region, leaves] : leaves_of) ASSERT_EQ(leaves, (faces_of[region] + leaf_faces - 1) / leaf_faces);
}

TEST(Region_tree, is_valid_after_the_build_and_after_every_refit) {
  for (const auto& [name, soup] : tree_cases())
    for (const std::size_t leaf_faces : {2, 3, 7, 32, 64, 127, 128})
      for (const bool divided : {false, true}) {
        SCOPED_TRACE(name + ", " + std::to_string(leaf_faces) + (divided ? ", divided" : ""));
        const Labels labels = divided ? octants(soup) : Labels();
        Region_tree tree(soup.faces, labels, soup.coordinates, {.leaf_faces = leaf_faces});
        expect_tree(tree, soup, soup.coordinates);
        expect_leaves_of_regions(tree, soup, labels, leaf_faces);
        std::mt19937_64 random(1);
        for (const double distance : {0.0, 0.01, 1.0, 100.0}) {
          const auto now = crumpled(posed_at_random(soup, distance, random), distance, 1);
          ASSERT_TRUE(tree.refit(now.coordinates));
          expect_tree(tree, soup, now.coordinates);
        }
      }
}

/// The extents of all leaves but that of a face, together.
double extent_of_leaves(const Face_soup& soup, std::optional<std::uint32_t> without = {}, std::size_t threads = 1) {
  Workers workers(threads);
  const Region_tree tree(soup.faces, Labels(), soup.coordinates, {}, workers);
  double sum = 0;
  for (std::uint32_t leaf = 0; leaf < tree.leaf_count(); ++leaf)
    if (!without || std::ranges::find(tree.faces(leaf), *without) == tree.faces(leaf).end())
      sum += tree.volume(tree.leaf_node(leaf)).extent();
  return sum;
}

TEST(Region_tree, has_leaves_as_small_as_ever_where_a_vertex_or_a_face_is_very_far_away) {
  const Face_soup ball = shuffled(Face_soup(icosphere(40)), 3);
  const double usual = extent_of_leaves(ball);
  for (const double distance : {1e6, 1e9, 1e300}) {
    Face_soup stray = ball;
    stray.coordinates.insert(stray.coordinates.end(), {distance, distance, distance});
    EXPECT_LT(extent_of_leaves(stray), 1.1 * usual) << distance;
    const auto vertex = stray.vertex_count() - 1;
    stray.faces.push_back({vertex, vertex, vertex});
    const auto last = static_cast<std::uint32_t>(stray.faces.size() - 1);
    const double far = extent_of_leaves(stray, last);
    EXPECT_LT(far, 3 * usual) << distance;
    EXPECT_EQ(far, extent_of_leaves(stray, last, 2)) << distance;
  }
}

TEST(Region_tree, has_nodes_above_its_regions_as_small_as_ever_where_a_vertex_is_very_far_away) {
  Face_soup ball(icosphere(12));
  const auto extent_of_nodes = [&] {
    Labels labels;  // of small parts of space, in an order that has nothing to do with where they are
    for (std::uint32_t v = 0; v < ball.vertex_count(); ++v) {
      const Point p = ball.point(v);
      const auto cell = [](double x) { return static_cast<Region_index>(std::clamp(2 + 2 * x, 0.0, 3.0)); };
      labels.push_back((16 * cell(p.x()) + 4 * cell(p.y()) + cell(p.z())) * 27 % 64);
    }
    const Region_tree tree(ball.faces, labels, ball.coordinates, {});
    double sum = 0;
    for (std::uint32_t n = 0; n < tree.node_count(); ++n) sum += tree.volume(n).extent();
    return sum;
  };
  const double usual = extent_of_nodes();
  ball.coordinates.insert(ball.coordinates.end(), {1e9, 1e9, 1e9});
  EXPECT_LT(extent_of_nodes(), 1.1 * usual);
}

TEST(Region_tree, of_any_labels_is_valid) {
  std::mt19937_64 random(1);
  const Face_soup soup(icosphere(6));
  for (const Region_index regions : {2U, 30U, 5000U}) {
    Labels labels(soup.vertex_count());
    for (auto& label : labels) label = static_cast<Region_index>(random() % regions);
    const Region_tree tree(soup.faces, labels, soup.coordinates, {.leaf_faces = 8});
    expect_tree(tree, soup, soup.coordinates);
    expect_leaves_of_regions(tree, soup, labels, 8);
  }
}

TEST(Region_tree, of_a_hundred_thousand_faces_is_valid) {
  for (const auto& soup : {Face_soup(icosphere(71)), shuffled(Face_soup(cloth(300, 170)), 1)})
    for (const std::size_t leaf_faces : {2, 32, 128}) {
      Region_tree tree(soup.faces, octants(soup), soup.coordinates, {.leaf_faces = leaf_faces});
      expect_leaves_of_regions(tree, soup, octants(soup), leaf_faces);
      const auto now = crumpled(soup, 0.1, 1);
      ASSERT_TRUE(tree.refit(now.coordinates));
      expect_tree(tree, soup, now.coordinates);
    }
}

TEST(Region_tree, is_the_same_for_any_number_of_workers) {
  // The first two are large enough for workers to share their uppermost splits.
  for (const auto& soup : {Face_soup(icosphere(60)), shuffled(Face_soup(cloth(210, 170)), 1),
                           shuffled(Face_soup(cloth(90, 70)), 1), Face_soup(icosphere(1))})
    for (const bool divided : {false, true}) {
      const Labels labels = divided ? octants(soup) : Labels();
      const Region_tree alone(soup.faces, labels, soup.coordinates);
      for (const std::size_t threads : {2, 3, 8}) {
        Workers workers(threads);
        const Region_tree shared(soup.faces, labels, soup.coordinates, {}, workers);
        expect_tree(shared, soup, soup.coordinates);
        EXPECT_TRUE(std::ranges::equal(shared.all_vertices(), alone.all_vertices()));
        EXPECT_TRUE(std::ranges::equal(shared.volumes(), alone.volumes()));
        ASSERT_EQ(shared.leaf_count(), alone.leaf_count());
        for (std::size_t leaf = 0; leaf < alone.leaf_count(); ++leaf)
          EXPECT_TRUE(std::ranges::equal(shared.faces(leaf), alone.faces(leaf)));
      }
    }
}

/// The lowest and the highest centre of the faces below a node, on one axis.
std::pair<double, double> range_of_centres(const Region_tree& tree, const Face_soup& soup, std::uint32_t n, int axis) {
  std::pair range(std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity());
  for (std::uint32_t leaf = tree.node(n).leaf; leaf < tree.node(n).end_leaf; ++leaf)
    for (const auto face : tree.faces(leaf)) {
      const Triangle triangle = soup.triangle(face);
      const double centre = (triangle[0][axis] + triangle[1][axis] + triangle[2][axis]) / 3;
      range = {std::min(range.first, centre), std::max(range.second, centre)};
    }
  return range;
}

TEST(Region_tree, splits_along_the_axis_on_which_centres_are_spread_widest) {
  for (const auto& soup : {Face_soup(torus_knot()), moved(shuffled(Face_soup(cloth(70, 30)), 1), 1000, 0, -3)}) {
    const Region_tree tree(soup.faces, {}, soup.coordinates, {.leaf_faces = 16});
    for (std::uint32_t n = 0; n < tree.node_count(); ++n) {
      if (tree.is_leaf(n)) continue;
      double widest = 0, widest_that_parts = 0;
      for (const int axis : {0, 1, 2}) {
        const auto [low, high] = range_of_centres(tree, soup, n, axis);
        widest = std::max(widest, high - low);
        const double end = range_of_centres(tree, soup, n + 1, axis).second;
        const double begin = range_of_centres(tree, soup, tree.node(n).second_child, axis).first;
        if (end <= begin + 1e-6) widest_that_parts = std::max(widest_that_parts, high - low);
      }
      EXPECT_NEAR(widest_that_parts, widest, 1e-6) << "node " << n;
    }
  }
}

TEST(Region_tree, of_coordinates_of_any_size_is_that_of_the_same_faces_elsewhere) {
  const Face_soup soup(icosphere(20));
  const Region_tree tree(soup.faces, {}, soup.coordinates);
  for (const double unit : {0x1p-1000, 0x1p-300, 0x1p300, 0x1p1000}) {
    auto other = soup;
    for (auto& coordinate : other.coordinates) coordinate *= unit;
    const Region_tree scaled(other.faces, {}, other.coordinates);
    EXPECT_TRUE(std::ranges::equal(scaled.all_vertices(), tree.all_vertices())) << unit;
  }
}

TEST(Region_tree, validation_reports_other_faces_and_other_coordinates) {
  const Face_soup soup(icosphere(5));
  const Region_tree tree(soup.faces, octants(soup), soup.coordinates);
  for (std::size_t i = 0; i < soup.coordinates.size(); i += 7) {
    auto other = soup.coordinates;
    other[i] += i % 2 == 0 ? 3 : -3;
    EXPECT_NE(tree.validate(soup.faces, other), "") << i;
  }
  EXPECT_NE(tree.validate(soup.faces, placed(soup, 0.5).coordinates), "") << "boxes that are too large";
  EXPECT_NE(tree.validate(std::span(soup.faces).first(soup.faces.size() - 1), soup.coordinates), "");
  auto faces = soup.faces;
  faces.push_back(faces[0]);
  EXPECT_NE(tree.validate(faces, soup.coordinates), "");
  faces = soup.faces;
  std::swap(faces.front(), faces.back());
  EXPECT_NE(tree.validate(faces, soup.coordinates), "");
  faces = soup.faces;
  faces[9][1] = faces[200][0];
  EXPECT_NE(tree.validate(faces, soup.coordinates), "");
}

TEST(Region_tree, leaf_sizes_out_of_range_are_refused) {
  const Face_soup soup(icosphere(2));
  for (const std::size_t leaf_faces : {std::size_t{0}, std::size_t{1}, std::size_t{129}, ~std::size_t{0}})
    EXPECT_THROW(Region_tree(soup.faces, {}, soup.coordinates, {.leaf_faces = leaf_faces}), Bad_argument);
}

}  // namespace
}  // namespace lodestone
