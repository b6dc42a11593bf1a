// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes of skinned and of morphed nodes, and the sums of morph targets: the formulas in plain loops, and the same bits
// on every instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <vector>

#include "lodestone/bounds/linear_bound.h"
#include "lodestone/bounds/morph_shifts.h"
#include "lodestone/bounds/skin_bound.h"
#include "support/instruction_sets.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

/// What one joint does to some vertices.
struct Share {
  double least, greatest;                   ///< weights
  std::vector<Eigen::Vector3d> moved = {};  ///< the corners of its box at rest, where the joint takes them
};

/// Some vertices that follow several joints, and the joints' motions.
struct Skin {
  Face_soup soup = Face_soup(icosphere(5));
  std::size_t joints;
  Joint_influences influences = {};
  std::vector<Eigen::Affine3d> motions = {};

  Skin(std::size_t joint_count, std::size_t most, std::mt19937_64& random) : joints(joint_count) {
    std::uniform_real_distribution<double> number(-1, 1);
    for (std::uint32_t v = 0; v < soup.vertex_count(); ++v) {
      const std::size_t first = random() % joints, count = 1 + random() % most;
      for (std::size_t i = 0; i < count; ++i) {
        influences.joints.push_back(static_cast<std::uint32_t>((first + i) % joints));
        influences.weights.push_back(1.1 + number(random));
      }
      influences.begin.push_back(static_cast<std::uint32_t>(influences.joints.size()));
    }
    motions.resize(joints);
    for (auto& motion : motions)
      for (Eigen::Index i = 0; i < 12; ++i) motion(i % 3, i / 3) = number(random);
  }
};

/// max sum_j w_j M_j: starts with the least weights, and hands out the rest by descending M_j.
double greatest_coordinate(const std::map<std::uint32_t, Share>& shares, const Eigen::Vector3d& direction) {
  std::vector<std::pair<double, double>> ends;  // M_j, how much more weight the joint can have
  double sum = 0, left = 1;
  for (const auto& [joint, share] : shares) {
    double end = -std::numeric_limits<double>::infinity();
    for (const auto& corner : share.moved) end = std::max(end, direction.dot(corner));
    ends.emplace_back(end, share.greatest - share.least);
    sum += share.least * end;
    left -= share.least;
  }
  std::ranges::sort(ends, std::greater());
  for (const auto& [end, room] : ends) {
    sum += std::min(room, left) * end;
    left -= std::min(room, left);
  }
  return sum;
}

std::map<std::uint32_t, Share> shares_of(const Skin& skin, const Skinned_points& points,
                                         std::span<const std::uint32_t> vertices) {
  std::map<std::uint32_t, Share> shares;
  std::map<std::uint32_t, Eigen::AlignedBox3d> boxes;
  std::map<std::uint32_t, std::size_t> followers;
  for (const auto v : vertices) {
    std::map<std::uint32_t, double> weights;
    const auto [joints, of_joints] = points.influences(v);
    for (std::size_t i = 0; i < joints.size(); ++i) weights[joints[i]] += of_joints[i];
    for (const auto& [joint, weight] : weights) {
      auto& share = shares.try_emplace(joint, Share{weight, weight}).first->second;
      share.least = std::min(share.least, weight);
      share.greatest = std::max(share.greatest, weight);
      boxes[joint].extend(Eigen::Vector3d::Map(&skin.soup.coordinates[3 * std::size_t{v}]));
      ++followers[joint];
    }
  }
  for (auto& [joint, share] : shares) {
    if (followers[joint] < vertices.size()) share.least = 0;
    for (int corner = 0; corner < 8; ++corner)
      share.moved.push_back(skin.motions[joint] *
                            boxes[joint].corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
  }
  return shares;
}

TEST(Skin_box, is_that_of_plain_loops) {
  std::mt19937_64 random(4);
  for (const std::size_t joints : {1, 2, 3, 5, 12, 40})
    for (const std::size_t most : {1, 2, 4}) {
      const Skin skin(joints, std::min(most, joints), random);
      Skinned_points points(skin.soup.coordinates, skin.influences, joints);
      points.set_joints(skin.motions);
      const Tree_layout layout(skin.soup.faces, {}, skin.soup.coordinates, {.leaf_faces = 6});
      const Skin_bound bound(points, layout);
      for (std::uint32_t leaf = 0; leaf < layout.leaf_count(); ++leaf) {
        const Aabb box = bound.box(layout.leaf_node(leaf));
        const auto shares = shares_of(skin, points, layout.vertices(leaf));
        for (int axis = 0; axis < 3; ++axis) {
          const Eigen::Vector3d up = Eigen::Vector3d::Unit(axis);
          EXPECT_NEAR(box.high[axis], greatest_coordinate(shares, up), 1e-12) << joints << " joints, leaf " << leaf;
          EXPECT_NEAR(box.low[axis], -greatest_coordinate(shares, -up), 1e-12) << joints << " joints, leaf " << leaf;
        }
      }
    }
}

/// Targets that move all vertices, and some that move every third.
std::vector<Morph_target> some_targets(std::size_t vertex_count, std::size_t count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<Morph_target> targets(count);
  for (std::size_t target = 0; target < count; ++target)
    for (std::uint32_t v = 0; v < vertex_count; v += target % 2 == 0 ? 1 : 3) {
      if (target % 2 != 0) targets[target].vertices.push_back(v);
      for (int axis = 0; axis < 3; ++axis) targets[target].offsets.push_back(number(random));
    }
  return targets;
}

TEST(Skin_box, is_the_same_for_every_instruction_set) {
  std::mt19937_64 random(5);
  for (const std::size_t joints : {1, 3, 20}) {
    const Skin skin(joints, std::min<std::size_t>(4, joints), random);
    const Morphed_points shape(skin.soup.coordinates, some_targets(skin.soup.vertex_count(), 5, random));
    Skinned_points points(shape, skin.influences, joints);
    points.set_joints(skin.motions);
    const Tree_layout layout(skin.soup.faces, {}, skin.soup.coordinates, {.leaf_faces = 6});
    const Skin_bound bound(points, layout);
    const Linear_bound of_shape(points.shape(), layout);
    points.set_weights(std::vector{0.3, -1.7, 0.0, 2.1, -0.01});
    std::vector<Aabb> first;
    for_instruction_sets([&] {
      std::vector<Aabb> boxes;
      for (std::uint32_t node = 0; node < layout.node_count(); ++node)
        boxes.insert(boxes.end(), {bound.box(node), of_shape.box(node)});
      if (first.empty()) first = boxes;
      EXPECT_EQ(boxes, first);
    });
  }
}

/// What a target adds is infinite, and what another takes away too: their sum is no number.
TEST(Skin_box, of_targets_that_overflow_both_ways_says_nothing_on_any_instruction_set) {
  std::mt19937_64 random(6);
  const Skin skin(3, 2, random);
  std::vector<Morph_target> targets(2);
  for (auto& target : targets) target.offsets.assign(skin.soup.coordinates.size(), 100);
  Skinned_points points(Morphed_points(skin.soup.coordinates, targets), skin.influences, skin.joints);
  const Tree_layout layout(skin.soup.faces, {}, skin.soup.coordinates, {.leaf_faces = 6});
  const Skin_bound bound(points, layout);
  const Linear_bound of_shape(points.shape(), layout);
  points.set_weights(std::vector{1e308, -1e308});
  constexpr double end = std::numeric_limits<double>::infinity();
  const Aabb all{.low = {-end, -end, -end, 0}, .high = {end, end, end, 0}};
  for_instruction_sets([&] {
    for (std::uint32_t node = 0; node < layout.node_count(); ++node) {
      EXPECT_EQ(bound.box(node), all);
      EXPECT_EQ(of_shape.box(node), all);
    }
  });
}

TEST(Morph_shifts, are_the_sums_of_plain_loops_on_every_instruction_set) {
  std::mt19937_64 random(8);
  const Face_soup soup(icosphere(3));
  const auto targets = some_targets(soup.vertex_count(), 4, random);
  Morphed_points points(soup.coordinates, targets);
  const Tree_layout layout(soup.faces, {}, soup.coordinates, {});
  const Morph_shifts shifts(points, layout);
  for (const auto& weights : {std::vector{0.5, -2.0, 0.0, 3.0}, std::vector{-1.0, 0.0, 0.0, 0.0}}) {
    points.set_weights(weights);
    for_instruction_sets([&] {
      const Morph_shift shift = shifts[0];  // of all vertices
      for (std::size_t axis = 0; axis < 3; ++axis) {
        double low = 0, high = 0, magnitude = 0;
        for (std::size_t target = 0; target < targets.size(); ++target) {
          const bool moves_all = targets[target].vertices.empty();  // the others stay: 0
          double least = moves_all ? 9 : 0, greatest = moves_all ? -9 : 0;
          for (std::size_t i = axis; i < targets[target].offsets.size(); i += 3) {
            least = std::min(least, targets[target].offsets[i]);
            greatest = std::max(greatest, targets[target].offsets[i]);
          }
          const double one = weights[target] * least, other = weights[target] * greatest;
          low += std::min(one, other);
          high += std::max(one, other);
          magnitude += std::max(std::abs(one), std::abs(other));
        }
        EXPECT_EQ(shift.low[axis], low);
        EXPECT_EQ(shift.high[axis], high);
        EXPECT_EQ(shift.magnitude[axis], magnitude);
      }
      const auto count = static_cast<double>(weights.size()) - static_cast<double>(std::ranges::count(weights, 0.0));
      EXPECT_EQ(shift.rounding, (4 * count + 16) * 0x1p-53);
      EXPECT_EQ(shift.underflow, count * 0x1p-1020);
    });
  }
  points.set_weights(std::vector<double>(4, 0));
  for_instruction_sets([&] {
    const Morph_shift none = shifts[0];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(none.low[axis], 0);
      EXPECT_EQ(none.high[axis], 0);
    }
    EXPECT_EQ(none.rounding, 0);
    EXPECT_EQ(none.underflow, 0);
  });
}

}  // namespace
}  // namespace lodestone
