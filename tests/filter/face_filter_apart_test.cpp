// SPDX-License-Identifier: GPL-3.0-or-later
// Faces that are apart are discarded, though their boxes overlap.
#include <Eigen/Geometry>

#include "filter/filter_checks.h"
#include "support/hard_pairs.h"

namespace lodestone {
namespace {

/// Pairs whose boxes overlap, and which are a gap apart: along the normal of one of them, or across one of its edges
/// within its plane.
std::vector<Triangle_pair> apart_by(double gap, std::mt19937_64& random, int count) {
  std::vector<Triangle_pair> pairs;
  std::uniform_real_distribution<double> unit(-1, 1);
  while (std::ssize(pairs) < count) {
    const auto vector = [&] {
      const double x = unit(random), y = unit(random), z = unit(random);
      return Eigen::Vector3d(x, y, z);
    };
    std::array<Eigen::Vector3d, 3> a{vector(), vector(), vector()}, b{vector(), vector(), vector()};
    const Eigen::Vector3d edge = a[1] - a[0], normal = edge.cross(a[2] - a[0]);
    if (normal.norm() < 0.1) continue;
    const Eigen::Vector3d axis = (pairs.size() % 2 == 0 ? normal : normal.cross(edge)).normalized();
    const auto along = [&](const auto& p) { return axis.dot(p); };
    const double top = std::max({along(a[0]), along(a[1]), along(a[2])});
    const double low = std::min({along(b[0]), along(b[1]), along(b[2])});
    Eigen::AlignedBox3d box_a, box_b;
    for (auto& p : b) p += (top - low + gap) * axis, box_b.extend(p);
    for (const auto& p : a) box_a.extend(p);
    if (!box_a.intersects(box_b)) continue;
    const auto triangle = [](const auto& t) {
      const auto point = [](const auto& p) { return Point(p.x(), p.y(), p.z()); };
      return Triangle{point(t[0]), point(t[1]), point(t[2])};
    };
    pairs.emplace_back(triangle(a), triangle(b));
  }
  return pairs;
}

TEST(Face_filter, discards_faces_that_a_normal_or_edge_of_one_of_them_separates) {
  std::mt19937_64 random(1);
  Single_leaf a(1), b(1);
  for (const Placement& placement : {Placement{1, 0}, {1, 1}, {0x1p-200, 0}, {0x1p200, 0}})
    for (const auto& [s, t] : apart_by(1e-9, random, 2000)) {
      a.set(0, placed(s, placement)), b.set(0, placed(t, placement));
      a.refit(), b.refit();
      ASSERT_TRUE(candidate_pairs(a.view(), b.view(), 0).empty()) << placement.scale;
      ASSERT_TRUE(candidate_pairs(b.view(), a.view(), 0).empty()) << placement.scale;
    }
  // Below 1e-90 and above 1e90, where determinants prove nothing, a normal still separates.
  const auto pairs = apart_by(1e-9, random, 2000);
  for (const double scale : {0x1p-310, 0x1p310})
    for (std::size_t i = 0; i < pairs.size(); i += 2) {
      a.set(0, placed(pairs[i].a, {scale, 0})), b.set(0, placed(pairs[i].b, {scale, 0}));
      a.refit(), b.refit();
      ASSERT_TRUE(candidate_pairs(a.view(), b.view(), 0).empty()) << scale;
    }
  for (const auto& [s, t] : apart_by(0.1, random, 2000)) {
    a.set(0, s), b.set(0, t);
    a.refit(), b.refit();
    ASSERT_TRUE(candidate_pairs(a.view(), b.view(), 0.1 - 1e-9).empty());
  }
}

/// Pairs that are a gap apart across an edge of each, and in no direction given by one of them alone: two edges at
/// right angles, one above the other, and faces that lean away from them.
std::vector<Triangle_pair> apart_across_edges(double gap, std::mt19937_64& random, int count) {
  std::vector<Triangle_pair> pairs;
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < count; ++i) {
    const double w = unit(random), u = unit(random), v = unit(random), t = unit(random);
    const Eigen::Matrix3d rotation = Eigen::Quaterniond(w, u, v, t).normalized().toRotationMatrix();
    const auto point = [&](double x, double y, double z) {
      const Eigen::Vector3d p = rotation * Eigen::Vector3d(x, y, z);
      return Point(p.x(), p.y(), p.z());
    };
    const double x = 0.2 * unit(random), y = 0.2 * unit(random);
    Triangle a{point(-2, y, 0), point(2, y, 0), point(0, y + 1.5, -2)};
    Triangle b{point(x, -2, gap), point(x, 2, gap), point(x - 1.5, 0, 2 + gap)};
    std::ranges::rotate(a, a.begin() + i % 3);
    std::ranges::rotate(b, b.begin() + i / 3 % 3);
    pairs.emplace_back(a, b);
  }
  return pairs;
}

TEST(Face_filter, discards_faces_that_an_edge_of_each_separates) {
  std::mt19937_64 random(1);
  Single_leaf a(1), b(1);
  for (const Placement& placement : {Placement{1, 0}, {1, 1}, {0x1p-200, 0}, {0x1p200, 0}})
    for (const auto& [s, t] : apart_across_edges(1e-9, random, 500)) {
      a.set(0, placed(s, placement)), b.set(0, placed(t, placement));
      a.refit(), b.refit();
      ASSERT_TRUE(candidate_pairs(a.view(), b.view(), 0).empty()) << placement.scale;
      ASSERT_TRUE(candidate_pairs(b.view(), a.view(), 0).empty()) << placement.scale;
    }
}

TEST(Face_filter, keeps_few_pairs_of_parallel_leaves_whose_boxes_overlap) {
  Face_soup low(cloth(8, 8)), high = low;
  deform(low, [](const Point& p) { return Point(p.x(), p.y(), p.x()); });
  deform(high, [](const Point& p) { return Point(p.x(), p.y(), p.x() + 0.2); });
  const Posed_object a(low, 128, false), b(high, 128, false);
  ASSERT_EQ(a.object().tree().leaf_count(), 1U);
  EXPECT_TRUE(candidate_pairs(a.view(), b.view(), 0).empty());
  const auto candidates = candidate_pairs(a.view(), b.view(), 0.15);
  EXPECT_GT(candidates.size(), 0U);
  EXPECT_LT(candidates.size(), 128U * 128 / 5);
}

}  // namespace
}  // namespace lodestone
