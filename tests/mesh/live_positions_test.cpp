// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/live_positions.h"

#include <gtest/gtest.h>

#include <vector>

namespace lodestone {
namespace {

/// Three vertices in memory.
std::vector<double> three_vertices() { return {1, 2, 3, -4, 5, 6.5, 0, 0, 1e9}; }

Eigen::Vector3d vertex_in(const std::vector<double>& coordinates, std::uint32_t vertex) {
  return Eigen::Map<const Eigen::Vector3d>(coordinates.data() + 3 * std::size_t{vertex});
}

/// Reads a vertex of a list of coordinates through a pointer to it.
Eigen::Vector3d read_list(const void* list, std::uint32_t vertex) {
  return vertex_in(*static_cast<const std::vector<double>*>(list), vertex);
}

Rigid_motion quarter_turn() {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.rotate(Eigen::AngleAxisd(EIGEN_PI / 2, Eigen::Vector3d::UnitZ()));
  motion.pretranslate(Eigen::Vector3d(10, 0, -1));
  return Rigid_motion(motion);
}

TEST(Live_positions, in_memory_are_those_that_it_holds_now) {
  auto list = three_vertices();
  const Live_positions positions(list.data());
  EXPECT_EQ(positions.memory(), list.data());
  for (const double change : {0.0, 1.0}) {
    list[4] += change;
    for (std::uint32_t v = 0; v < 3; ++v) EXPECT_EQ(positions(v), vertex_in(list, v));
  }
}

TEST(Live_positions, of_a_mesh_are_those_that_its_function_reads_now) {
  auto list = three_vertices();
  const Live_positions positions(&list, read_list);
  EXPECT_EQ(positions.memory(), nullptr);
  for (const double change : {0.0, 1.0}) {
    list[4] += change;
    for (std::uint32_t v = 0; v < 3; ++v) EXPECT_EQ(positions(v), vertex_in(list, v));
  }
}

TEST(Live_positions, of_a_placed_object_are_turned_and_moved_and_do_not_lie_in_memory) {
  const auto list = three_vertices();
  for (const auto& positions :
       {Live_positions(list.data(), quarter_turn()), Live_positions(&list, read_list, quarter_turn())}) {
    EXPECT_EQ(positions.memory(), nullptr);
    for (std::uint32_t v = 0; v < 3; ++v) {
      const auto p = vertex_in(list, v);
      const Eigen::Vector3d expected(10 - p.y(), p.x(), p.z() - 1);
      EXPECT_LT((positions(v) - expected).norm(), 1e-14 * (1 + p.norm())) << v;
    }
  }
}

}  // namespace
}  // namespace lodestone
