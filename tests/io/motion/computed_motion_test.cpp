// SPDX-License-Identifier: GPL-3.0-or-later
// Motions as computed points: the positions of the motion itself, one by one, in lists and all at once.
#include "lodestone/io/motion/computed_motion.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <memory>
#include <vector>

#include "lodestone/io/motion/animation.h"
#include "lodestone/io/motion/deformation.h"
#include "lodestone/io/scenes/given_objects.h"
#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/tree/tree_surface.h"
#include "support/temporary_folder.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

/// Every third vertex of a motion, backwards.
std::vector<std::uint32_t> some_vertices(std::size_t count) {
  std::vector<std::uint32_t> vertices;
  for (std::size_t v = count; v-- > 0;)
    if (v % 3 == 1) vertices.push_back(static_cast<std::uint32_t>(v));
  return vertices;
}

void expect_positions_of(const Motion& motion, std::size_t vertex_count, std::vector<std::size_t> frames) {
  ASSERT_TRUE(motion.computed);
  const auto vertices = some_vertices(vertex_count);
  const auto computed = motion.computed(vertices);
  ASSERT_EQ(computed->vertex_count(), vertices.size());
  std::vector<Point> truth(vertex_count);
  for (const std::size_t frame : frames) {
    SCOPED_TRACE(frame);
    motion.pose(frame, truth);
    computed->set_frame(frame);
    EXPECT_GT(computed->pose_number(), 0U);
    const double unset = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> all(3 * vertices.size(), unset), list = all;
    computed->pose_all(all);
    std::vector<std::uint32_t> odd;
    for (std::uint32_t i = 1; i < vertices.size(); i += 2) odd.push_back(i);
    computed->pose(odd, list);
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
      const Point& p = truth[vertices[i]];
      const Eigen::Vector3d single = (*computed)(i);
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_EQ(all[3 * i + static_cast<std::size_t>(axis)], p[axis]);
        ASSERT_EQ(single[axis], p[axis]);
        if (i % 2 == 1) {
          ASSERT_EQ(list[3 * i + static_cast<std::size_t>(axis)], p[axis]);
        }
      }
    }
  }
}

std::vector<Point> points_of(const Surface_mesh& mesh) { return {mesh.points().begin(), mesh.points().end()}; }

TEST(Computed_motion, stands_where_nothing_moves_and_has_one_pose) {
  const auto mesh = potato(5);
  const Motion motion = deform(points_of(mesh), {});
  expect_positions_of(motion, mesh.number_of_vertices(), {0, 7});
  const auto computed = motion.computed(some_vertices(mesh.number_of_vertices()));
  const auto before = computed->pose_number();
  computed->set_frame(3);
  EXPECT_EQ(computed->pose_number(), before);
}

TEST(Computed_motion, has_the_positions_of_deformations) {
  const auto mesh = potato(5);
  expect_positions_of(deform(points_of(mesh), {Wobble{.amplitude = 0.2}, Twist{.degrees = 50}, Bend{}, Spin{}}),
                      mesh.number_of_vertices(), {0, 1, 9});
}

TEST(Computed_motion, has_the_positions_of_characters_that_are_placed) {
  const test::Temporary_folder folder;
  std::filesystem::copy_file(LODESTONE_DATA "/characters/body.glb", folder.path() / "body.glb");
  const auto file = folder.write("scene.json", R"({"frames": 50, "objects": [
    {"name": "body", "mesh": "body.glb", "motion": {"gltf": "body.glb"},
     "place": {"scale": [1, 2, 0.5], "rotate": {"axis": [1, 2, 3], "degrees": 40}, "translate": [3, 4, 5]}}]})");
  const Scene scene = read_scene(file);
  expect_positions_of(scene.objects[0].motion, scene.objects[0].file_vertices, {0, 13, 49});
}

TEST(Computed_motion, keeps_the_last_pose_of_a_motion_that_is_shorter_than_its_scene) {
  const auto animation = read_animation(LODESTONE_DATA "/characters/hand.glb");
  const std::size_t last = animation.motion.frames - 1;
  const auto computed = held(animation.motion.computed(some_vertices(animation.vertices)), last);
  computed->set_frame(last);
  const auto number = computed->pose_number();
  const auto positions = [&] {
    std::vector<double> all(3 * std::size_t{computed->vertex_count()});
    computed->pose_all(all);
    return all;
  };
  const auto at = positions();
  computed->set_frame(last + 10);
  EXPECT_EQ(computed->pose_number(), number);
  computed->set_frame(last / 2);
  EXPECT_NE(positions(), at);
  computed->set_frame(last + 3);
  EXPECT_EQ(positions(), at);
}

TEST(Computed_motion, lies_in_the_boxes_of_its_bound) {
  const auto mesh = potato(8);
  const auto points = points_of(mesh);
  const Mesh_numbering<Surface_mesh> numbering(mesh);
  std::vector<std::uint32_t> all(points.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  const Kernel::Aff_transformation_3 placement(0, -2, 0, 3, 1, 0, 0.5, 4, 0, 0, 3, 5);
  for (const bool is_placed : {false, true})
    for (const auto& deformations : {std::vector<Deformation>{}, {Twist{.degrees = 80, .period = 20}, Spin{}}}) {
      auto motion = deform(points, deformations).computed(all);
      if (is_placed) motion = placed(std::move(motion), placement);
      std::vector<double> coordinates(3 * points.size());
      motion->set_frame(0);
      motion->pose_all(coordinates);
      Tree_surface tree(numbering.corners(), coordinates, {.leaf_faces = 12});
      const Any_bound bound =
          motion->bound({.layout = tree.tree(), .labels = {}, .rest = coordinates, .positions = *motion});
      for (const std::size_t frame : {0, 5, 12}) {
        motion->set_frame(frame);
        std::vector<double> now(coordinates.size());
        motion->pose_all(now);
        for (std::uint32_t leaf = 0; leaf < tree.tree().leaf_count(); ++leaf) {
          const Aabb box = bound.box(tree.tree().leaf_node(leaf));
          ASSERT_LT(box.extent(), 100) << "a box around everything tells nothing";
          for (const auto v : tree.tree().vertices(leaf))
            for (std::size_t axis = 0; axis < 3; ++axis) {
              ASSERT_LE(box.low[axis], now[3 * v + axis]);
              ASSERT_GE(box.high[axis], now[3 * v + axis]);
            }
        }
      }
    }
}

}  // namespace
}  // namespace lodestone
