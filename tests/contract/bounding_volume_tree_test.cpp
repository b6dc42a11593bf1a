// SPDX-License-Identifier: GPL-3.0-or-later
// Region trees with every model of Bounding_volume, under deformations of every kind.
#include <limits>

#include "contract/volume_leaves.h"
#include "lodestone/tree/region_tree.h"
#include "support/special_numbers.h"
#include "support/tree_checks.h"

namespace lodestone {
namespace {

/// The coordinates of a mesh in a few frames: rest, crumpled, turned, bent, flat, a point, far away, tiny and huge.
std::vector<std::pair<std::string, std::vector<double>>> frames_of(const Face_soup& soup, std::mt19937_64& random) {
  const auto flat = bent(soup, [](const Point& p) { return Point(p.x(), p.y(), p.x() + p.y()); });
  const auto wave = bent(soup, [](const Point& p) { return Point(p.x(), p.y() + std::sin(3 * p.x()), 0.1 * p.z()); });
  const auto turned = posed_at_random(soup, 3, random);
  std::vector<std::pair<std::string, Face_soup>> frames{
      {"rest", soup},
      {"crumpled", crumpled(soup, 0.1, 1)},
      {"turned", turned},
      {"bent", wave},
      {"bent and turned", posed_at_random(wave, 1, random)},
      {"flat", flat},
      {"flat but for rounding", posed_at_random(flat, 0, random)},
      {"straight", bent(soup, [](const Point& p) { return Point(p.x(), 0.3 * p.x(), -0.7 * p.x()); })},
      {"in one point", bent(soup, [](const Point&) { return Point(0.1, 1e6, -1e-6); })},
      {"around", bent(soup, [](const Point& p) { return Point(std::cos(p.x()), std::sin(p.x()), p.y() / 9); })},
      {"far", placed(turned, 1, 0x1p20)},
      {"far and small", placed(turned, 1e-3, 1e12)},
      {"small", placed(turned, 0x1p-300)},
      {"denormal", placed(turned, 0x1p-1070)},
      {"huge", placed(turned, 0x1p300)},
      {"hugest", placed(turned, 0x1p1018)}};
  std::vector<std::pair<std::string, std::vector<double>>> coordinates;
  for (auto& [name, frame] : frames) {
    EXPECT_TRUE(finite(frame)) << name;
    coordinates.emplace_back(name, std::move(frame.coordinates));
  }
  return coordinates;
}

/// The parent of each node; that of the root is the root.
std::vector<std::uint32_t> parents_of(const Tree_layout& tree) {
  std::vector<std::uint32_t> parents(tree.node_count(), 0);
  for (std::uint32_t n = 0; n < tree.node_count(); ++n)
    if (!tree.is_leaf(n)) parents[n + 1] = parents[tree.node(n).second_child] = n;
  return parents;
}

/// Calls `visit` for a node and all its ancestors.
template <class Visit_node>
void visit_upwards(const std::vector<std::uint32_t>& parents, std::uint32_t n, Visit_node visit) {
  visit(n);
  while (n != 0) visit(n = parents[n]);
}

template <class Volume>
class Bounding_volume_tree : public ::testing::Test {
 protected:
  using Tree = Basic_region_tree<Volume>;

  /// Checks that points of faces of some leaves are in the leaves' volumes and in those of all ancestors.
  void expect_enclosed(const Tree& tree, const Face_soup& soup, const std::string& name) {
    constexpr std::size_t leaves_seen = 6, faces_seen = 3, vertices_seen = 12;
    const auto parents = parents_of(tree);
    for (std::size_t i = 0; i < std::min(leaves_seen, tree.leaf_count()); ++i) {
      const std::size_t leaf = tree.leaf_count() <= leaves_seen ? i : random_() % tree.leaf_count();
      std::vector<Exact_point> points;
      std::vector<Exact_triangle> triangles;
      for (std::size_t k = 0; k < vertices_seen; ++k)
        points.push_back(exact_point(soup.point(tree.vertices(leaf)[random_() % tree.vertices(leaf).size()])));
      for (std::size_t k = 0; k < faces_seen; ++k) {
        const auto face = tree.faces(leaf)[random_() % tree.faces(leaf).size()];
        const auto [a, b, c] = soup.triangle(face);
        triangles.push_back({exact_point(a), exact_point(b), exact_point(c)});
        for (const auto& p : points_of(soup.triangle(face), {}, random_)) points.push_back(p);
      }
      visit_upwards(parents, tree.leaf_node(leaf), [&](std::uint32_t n) {
        const auto& volume = tree.volume(n);
        auto outside = std::ranges::count_if(points, [&](const auto& p) { return !inside(volume, p); });
        for (const auto& centre : own_centres(volume))
          for (const auto& t : triangles) outside += inside(volume, nearest_point(t, centre)) ? 0 : 1;
        EXPECT_EQ(outside, 0) << name << ": node " << n << " above leaf " << leaf;
      });
    }
  }

  std::mt19937_64 random_{1};
};
TYPED_TEST_SUITE(Bounding_volume_tree, Volume_types, Volume_names);

TYPED_TEST(Bounding_volume_tree, every_volume_encloses_all_below_it_in_every_frame) {
  for (auto& [name, soup] : tree_cases())
    for (const std::size_t leaf_faces : {2, 24}) {
      Basic_region_tree<TypeParam> tree(soup.faces, octants(soup), soup.coordinates, {.leaf_faces = leaf_faces});
      EXPECT_EQ(tree.validate(soup.faces, soup.coordinates), "") << name;
      for (const auto& [frame, coordinates] : frames_of(soup, this->random_)) {
        auto now = soup;
        now.coordinates = coordinates;
        ASSERT_TRUE(tree.refit(coordinates));
        EXPECT_EQ(tree.validate(soup.faces, coordinates), "") << name << ", " << frame;
        this->expect_enclosed(tree, now, name + ", " + frame);
      }
    }
}

TYPED_TEST(Bounding_volume_tree, looseness_is_finite) {
  for (auto& [name, soup] : tree_cases()) {
    Basic_region_tree<TypeParam> tree(soup.faces, octants(soup), soup.coordinates, {.leaf_faces = 4});
    for (const auto& [frame, coordinates] : frames_of(soup, this->random_)) {
      ASSERT_TRUE(tree.refit(coordinates));
      EXPECT_TRUE(tree.looseness() >= 0 && std::isfinite(tree.looseness())) << name << ", " << frame;
    }
  }
}

TYPED_TEST(Bounding_volume_tree, a_refit_in_parts_in_any_order_equals_a_whole_refit) {
  const Face_soup soup(icosphere(71));
  Basic_region_tree<TypeParam> whole(soup.faces, octants(soup), soup.coordinates), parts = whole;
  ASSERT_GT(parts.part_count(), 1U);
  std::vector<std::size_t> order(parts.part_count());
  std::iota(order.begin(), order.end(), 0U);
  Workers workers(2);
  for (int frame = 0; frame < 3; ++frame) {
    const auto now = crumpled(soup, 0.1, static_cast<std::uint64_t>(frame));
    ASSERT_TRUE(whole.refit(now.coordinates));
    std::ranges::shuffle(order, this->random_);
    if (frame < 2)
      for (const auto part : order) parts.refit_part(part, now.coordinates);
    else
      workers.run(order.size(), [&](std::size_t part, std::size_t) { parts.refit_part(part, now.coordinates); });
    ASSERT_TRUE(parts.finish_refit(now.coordinates));
    EXPECT_TRUE(std::ranges::equal(parts.volumes(), whole.volumes()));
    EXPECT_EQ(parts.looseness(), whole.looseness());
    EXPECT_EQ(parts.validate(soup.faces, now.coordinates), "");
  }
}

TYPED_TEST(Bounding_volume_tree, a_refit_reports_a_non_finite_coordinate_and_the_next_recovers) {
  for (auto& [name, soup] : tree_cases()) {
    Basic_region_tree<TypeParam> tree(soup.faces, {}, soup.coordinates, {.leaf_faces = 4});
    const auto good = tree;
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity})
      for (int i = 0; i < 12; ++i) {
        auto now = soup.coordinates;
        const auto& face = soup.faces[this->random_() % soup.faces.size()];
        now[3 * face[i % 3] + this->random_() % 3] = bad;
        if (i == 11) std::ranges::fill(now, bad);
        EXPECT_FALSE(tree.refit(now)) << name;
      }
    ASSERT_TRUE(tree.refit(soup.coordinates)) << name;
    EXPECT_TRUE(std::ranges::equal(tree.volumes(), good.volumes())) << name;
  }
}

TYPED_TEST(Bounding_volume_tree, all_nodes_above_faces_that_meet_are_near) {
  std::size_t meeting = 0;
  for (const auto& place : {Placement{}, Placement{1, {0x1p20, 0x1p20, 0x1p20}}, Placement{0x1p300, {}},
                            Placement{0x1p-300, {}}, Placement{0x1p-537, {}}}) {
    auto objects = small_objects();
    for (std::size_t i = 0; i < objects.size(); ++i) {
      const Face_soup a = place(posed_at_random(objects[i].second, 0.3, this->random_)),
                      b = place(posed_at_random(objects[(i + 1) % objects.size()].second, 0.3, this->random_));
      const Basic_region_tree<TypeParam> tree_a(a.faces, octants(a), a.coordinates, {.leaf_faces = 4}),
          tree_b(b.faces, {}, b.coordinates, {.leaf_faces = 2});
      const auto truth = true_pairs(a, b);
      const auto leaf_nodes = [](const auto& tree, const Face_soup& soup) {
        std::vector<std::uint32_t> nodes(soup.faces.size());
        for (std::uint32_t leaf = 0; leaf < tree.leaf_count(); ++leaf)
          for (const auto face : tree.faces(leaf)) nodes[face] = tree.leaf_node(leaf);
        return nodes;
      };
      const auto leaves_a = leaf_nodes(tree_a, a), leaves_b = leaf_nodes(tree_b, b);
      const auto parents_a = parents_of(tree_a), parents_b = parents_of(tree_b);
      for (const auto& pair : truth)
        visit_upwards(parents_a, leaves_a[pair.a], [&](std::uint32_t n) {
          visit_upwards(parents_b, leaves_b[pair.b], [&](std::uint32_t m) {
            EXPECT_TRUE(near(tree_a.volume(n), tree_b.volume(m), 0)) << objects[i].first << ' ' << n << ' ' << m;
          });
        });
      meeting += truth.size();
    }
  }
  EXPECT_GT(meeting, 1000U);
}

}  // namespace
}  // namespace lodestone
