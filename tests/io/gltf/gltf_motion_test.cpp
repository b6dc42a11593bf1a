// SPDX-License-Identifier: GPL-3.0-or-later
// How glTF files move: curves, nodes, skins, morph targets, frames.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "io/gltf/gltf_files.h"
#include "lodestone/io/motion/animation.h"
#include "lodestone/mesh/errors.h"
#include "support/message_of.h"

namespace lodestone::test {
namespace {

using Json = nlohmann::json;

TEST_F(Gltf, nodes_move_their_children) {
  auto sample = square_gltf();
  const double half = std::sqrt(0.5);
  sample.json["nodes"] = {{{"mesh", 0}, {"translation", {1, 0, 0}}, {"scale", {2, 1, 1}}},
                          {{"children", {0}}, {"rotation", {0, 0, half, half}}},
                          {{"children", {1}}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 3, 0, 10, 20, 30, 1}}}};
  sample.json["scenes"] = {{{"nodes", {2}}}};
  expect_near(at_rest(sample),
              moved([](double x, double y, double z) { return Point(10 - y, 20 + 2 * x + 1, 30 + 3 * z); }));
}

TEST_F(Gltf, linear_curves_interpolate_between_keys_and_are_constant_outside) {
  auto sample = square_gltf();
  sample.animate(0, "translation", sample.add_numbers({0.5, 1.5}), sample.add_points({0, 0, 0, 0, 0, 4}));
  sample.animate(0, "scale", sample.add_numbers({0, 2}), sample.add_points({1, 1, 1, 1, 1, 1}));
  for (const auto& [time, z] : {std::pair{0.0, 0.0}, {0.5, 0.0}, {0.7, 0.8}, {1.5, 4.0}, {2.0, 4.0}})
    expect_near(at(sample, time), moved([z = z](double x, double y, double) { return Point(x, y, z); }));
}

TEST_F(Gltf, frames_between_keys_are_where_the_curve_is_at_their_time) {
  auto sample = square_gltf();
  sample.animate(0, "translation", sample.add_numbers({0, 1024}), sample.add_points({0, 0, 0, 0, 0, 1024}));
  const auto animation = read_animation(write(sample), {.frames_per_second = 10});
  std::vector<Point> positions(animation.vertices);
  for (const std::size_t frame : {1U, 777U, 10'003U}) {
    animation.motion.pose(frame, positions);
    EXPECT_NEAR(positions.front().z(), static_cast<double>(frame) / 10, 1e-9);  // as floats times differ by 1e-5
  }
}

TEST_F(Gltf, step_curves_are_constant_until_the_next_key) {
  auto sample = square_gltf();
  const auto times = sample.add_numbers({0, 0.1, 0.3, 0.7});
  sample.animate(0, "translation", times, sample.add_points({0, 0, 0, 0, 0, 1, 0, 0, 3, 0, 0, 7}), "STEP");
  for (const auto& [time, z] : {std::pair{0.0, 0.0}, {0.1, 1.0}, {0.2, 1.0}, {0.3, 3.0}, {0.6, 3.0}, {0.7, 7.0}})
    expect_near(at(sample, time), moved([z = z](double x, double y, double) { return Point(x, y, z); }));
}

TEST_F(Gltf, cubic_curves_are_hermite_splines) {
  // z(t) = t^3 with its slopes at 0 and 2 must be reproduced everywhere.
  auto sample = square_gltf();
  sample.animate(0, "translation", sample.add_numbers({0, 2}),
                 sample.add_points({9, 9, 9, 0, 0, 0, 0, 0, 0, 0, 0, 12, 0, 0, 8, 9, 9, 9}), "CUBICSPLINE");
  for (const double time : {0.0, 0.5, 1.0, 1.7, 2.0})
    expect_near(at(sample, time),
                moved([time](double x, double y, double) { return Point(x, y, time * time * time); }));
}

TEST_F(Gltf, rotations_have_constant_speed_along_the_shorter_way) {
  auto sample = square_gltf();
  const double half = std::sqrt(0.5);
  sample.animate(0, "rotation", sample.add_numbers({0, 1}), sample.add_quaternions({0, 0, 0, 1, 0, 0, -half, -half}));
  for (const double time : {0.0, 0.3, 0.5, 1.0}) {
    const double angle = time * std::acos(0);
    expect_near(at(sample, time), moved([angle](double x, double y, double z) {
                  return Point(std::cos(angle) * x - std::sin(angle) * y, std::sin(angle) * x + std::cos(angle) * y, z);
                }));
  }
}

TEST_F(Gltf, morph_targets_add_up) {
  auto sample = rich_gltf();
  sample.json.erase("animations");
  sample.json.erase("skins");
  sample.json["nodes"] = {{{"mesh", 0}, {"weights", {2, 3}}}};
  expect_near(at_rest(sample), {{0, 0, 2}, {1, 0, 2}, {4, 1, 2}, {0, 4, 2}});
  sample.json["nodes"] = {{{"mesh", 0}}};  // the mesh has weights 0 and 0.5
  expect_near(at_rest(sample), {{0, 0, 0}, {1, 0, 0}, {1.5, 1, 0}, {0, 1.5, 0}});
}

TEST_F(Gltf, morph_targets_move_only_the_primitives_that_have_them) {
  auto sample = rich_gltf();
  sample.json.erase("animations");
  sample.json.erase("skins");
  sample.json["nodes"] = {{{"mesh", 0}, {"weights", {2, 3}}}};
  // Squares before and after it that lie above, whose targets change something else than positions.
  auto& primitives = sample.json["meshes"][0]["primitives"];
  auto still = primitives[0];
  const auto normals = sample.add_points({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  still["targets"] = {{{"NORMAL", normals}}, {{"NORMAL", normals}}};
  still["attributes"] = {{"POSITION", sample.add_points({0, 0, 9, 1, 0, 9, 1, 1, 9, 0, 1, 9})}};
  auto behind = still;
  behind["attributes"] = {{"POSITION", sample.add_points({0, 0, -9, 1, 0, -9, 1, 1, -9, 0, 1, -9})}};
  primitives = nlohmann::json::array({still, primitives[0], behind});
  expect_near(at_rest(sample), {{0, 0, 9},
                                {1, 0, 9},
                                {1, 1, 9},
                                {0, 1, 9},
                                {0, 0, 2},
                                {1, 0, 2},
                                {4, 1, 2},
                                {0, 4, 2},
                                {0, 0, -9},
                                {1, 0, -9},
                                {1, 1, -9},
                                {0, 1, -9}});
}

TEST_F(Gltf, weights_of_a_curve_replace_all_others) {
  auto sample = rich_gltf();
  sample.json.erase("animations");
  sample.json.erase("skins");
  sample.json["nodes"] = {{{"mesh", 0}, {"weights", {2, 3}}}};
  const auto view = sample.add_view(packed<std::uint8_t>({0, 255, 255, 0}));
  const auto weights = sample.add_accessor(
      {{"bufferView", view}, {"componentType", 5121}, {"normalized", true}, {"count", 4}, {"type", "SCALAR"}});
  sample.animate(0, "weights", sample.add_numbers({0, 1}), weights);
  expect_near(at(sample, 0.2), {{0, 0, 0.2}, {1, 0, 0.2}, {1.8, 1, 0.2}, {0, 1.8, 0.2}});
}

TEST_F(Gltf, skins_move_vertices_with_their_joints_and_not_with_the_node) {
  auto sample = rich_gltf();
  sample.json.erase("animations");
  sample.json["meshes"][0]["weights"] = {0, 0};
  sample.json["nodes"][0]["translation"] = {100, 0, 0};
  sample.json["nodes"][0].erase("children");
  sample.json["scenes"] = {{{"nodes", {0, 1}}}};
  expect_near(at_rest(sample), square_points);
  // Joint 1 is at (1, 0, 0) at rest, and is lifted by 2 here.
  sample.json["nodes"][2]["translation"] = {1, 0, 2};
  expect_near(at_rest(sample), {{0, 0, 0}, {1, 0, 2 * 127 / 255.0}, {1, 1, 2}, {0, 1, 2}});
}

TEST_F(Gltf, nodes_with_the_same_skin_move_as_one_alone_does) {
  auto sample = rich_gltf();
  sample.json.erase("animations");
  sample.json["meshes"][0]["weights"] = {0, 0};
  sample.json["nodes"][0].erase("children");
  sample.json["nodes"][2]["translation"] = {1, 0, 2};
  sample.json["scenes"] = {{{"nodes", {0, 1}}}};
  const auto alone = at_rest(sample);
  sample.json["nodes"].push_back({{"mesh", 0}, {"translation", {0, 0, 7}}});  // without the skin
  sample.json["nodes"].push_back(sample.json["nodes"][0]);
  sample.json["scenes"] = {{{"nodes", {0, 1, 3, 4}}}};
  auto all = alone;
  for (const Point& p : square_points) all.emplace_back(p.x(), p.y(), 7);
  all.insert(all.end(), alone.begin(), alone.end());
  expect_near(at_rest(sample), all);
}

TEST_F(Gltf, nodes_skins_and_morph_targets_work_together) {
  // At 1 s: weights 1 and 0; joint 0 turned by 180 degrees about z; joint 1 at (1, 1, 0) below it, scaled by 1.5.
  const auto root = [](double x, double y, double z) { return Point(-x, -y, z); };
  const auto tip = [&](double x, double y, double z) { return root(1 + 1.5 * (x - 1), 1 + 1.5 * y, 1.5 * z); };
  const double w = 127 / 255.0;
  const auto a = root(1, 0, 1), b = tip(1, 0, 1);
  const Point mixed(a.x() + w * (b.x() - a.x()), a.y() + w * (b.y() - a.y()), a.z() + w * (b.z() - a.z()));
  expect_near(at(rich_gltf(), 1), {root(0, 0, 1), mixed, tip(1, 1, 1), tip(0, 1, 1)});
}

TEST_F(Gltf, the_last_frame_is_at_or_before_the_end_of_the_animation) {
  auto sample = square_gltf();
  sample.animate(0, "translation", sample.add_numbers({0, 1.1}), sample.add_points({0, 0, 0, 0, 0, 1}));
  const auto file = write(sample);
  EXPECT_EQ(read_animation(file).motion.frames, 34U);
  EXPECT_EQ(read_animation(file, {.frames_per_second = 10}).motion.frames, 12U);
  EXPECT_EQ(read_animation(file, {.frames_per_second = 0.5}).motion.frames, 1U);
  EXPECT_THROW(read_animation(file, {.frames_per_second = 1e6}), Bad_motion);
  for (const double rate : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_THROW(read_animation(file, {.frames_per_second = rate}), Bad_argument);
}

TEST_F(Gltf, uniform_keys_are_frames) {
  const auto frames_and_rate = [&](std::initializer_list<double> times, std::initializer_list<double> others) {
    auto sample = square_gltf();
    const auto curve = [&](const char* path, std::initializer_list<double> keys) {
      std::string points;
      for (std::size_t i = 0; i < 3 * keys.size(); ++i) points += packed<float>({1.0});
      const auto values = sample.add_accessor(
          {{"bufferView", sample.add_view(points)}, {"componentType", 5126}, {"count", keys.size()}, {"type", "VEC3"}});
      sample.animate(0, path, sample.add_numbers(keys), values);
    };
    curve("scale", times);
    curve("translation", others);
    const auto animation = read_animation(write(sample));
    return std::pair(animation.motion.frames, animation.frames_per_second);
  };
  using Frames_and_rate = std::pair<std::size_t, double>;
  EXPECT_EQ(frames_and_rate({0, 0.1, 0.2, 0.3}, {0, 0.3}), Frames_and_rate(4, 10));
  EXPECT_EQ(frames_and_rate({0.5, 0.6}, {0.7, 0.8}), Frames_and_rate(4, 10)) << "from the first key on";
  EXPECT_EQ(frames_and_rate({0, 0.1, 0.2, 0.3}, {0, 0.25}), Frames_and_rate(10, 30)) << "curves differ";
  EXPECT_EQ(frames_and_rate({0, 0.1, 0.4}, {0, 0.4}), Frames_and_rate(13, 30)) << "a hole";
  EXPECT_EQ(frames_and_rate({0, 0.2, 0.4}, {0}), Frames_and_rate(3, 5));
  EXPECT_EQ(frames_and_rate({0, 0.1, 0.2}, {0, 0.1 + 1e-8, 0.2}), Frames_and_rate(3, 10)) << "rounded otherwise";
  EXPECT_EQ(frames_and_rate({0, 1, 2}, {0, 2}), Frames_and_rate(61, 30)) << "too few keys to be frames";
  EXPECT_EQ(frames_and_rate({0, 0.1, 0.2, 0.2000001}, {0, 0.2}), Frames_and_rate(3, 10)) << "a key twice";
  EXPECT_EQ(frames_and_rate({0, 5e-6, 1e-5}, {0, 1e-5}), Frames_and_rate(3, 200'000)) << "fast, but one curve's";
  EXPECT_EQ(frames_and_rate({0}, {0}), Frames_and_rate(1, 30));
  EXPECT_EQ(frames_and_rate({5}, {1e9}), Frames_and_rate(1, 30)) << "nothing moves";
  EXPECT_EQ(frames_and_rate({0}, {0.1}), Frames_and_rate(1, 30)) << "nothing moves";
}

TEST_F(Gltf, curves_whose_keys_are_rounded_otherwise_are_at_their_keys) {
  for (const bool steps_are_late : {false, true}) {
    auto sample = square_gltf();
    const double late = std::nextafter(0.1F, 1.0F);
    const auto times = sample.add_numbers({0, 0.1, 0.2, 0.3}), others = sample.add_numbers({0, late, 0.2, 0.3});
    const auto curve = [&](const char* path, bool is_late, const char* interpolation) {
      sample.animate(0, path, is_late ? others : times, sample.add_points({1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4}),
                     interpolation);
    };
    curve("scale", steps_are_late, "STEP");
    curve("translation", !steps_are_late, "LINEAR");
    const auto file = write(sample);
    for (const auto& animation : {read_animation(file), read_animation(file, {.frames_per_second = 10})}) {
      ASSERT_EQ(animation.motion.frames, 4U);
      for (std::size_t frame = 0; frame < 4; ++frame) {
        std::vector<Point> positions(animation.vertices);
        animation.motion.pose(frame, positions);
        const double size = 1 + static_cast<double>(frame);
        expect_near(positions, moved([size](double x, double y, double) {
                      return Point(size + size * x, size + size * y, size);
                    }));
      }
    }
  }
}

TEST_F(Gltf, frames_at_late_keys_are_at_them_though_floats_are_coarse_there) {
  auto sample = square_gltf();
  const auto times = sample.add_numbers({0, 600.2, 600.4});  // as floats, the second is 0.000012 s later
  sample.animate(0, "translation", times, sample.add_points({0, 0, 0, 0, 0, 1, 0, 0, 2}), "STEP");
  const auto animation = read_animation(write(sample), {.frames_per_second = 10});
  std::vector<Point> positions(animation.vertices);
  for (const auto& [frame, z] : {std::pair{6001U, 0.0}, {6002U, 1.0}, {6003U, 1.0}, {6004U, 2.0}}) {
    animation.motion.pose(frame, positions);
    EXPECT_EQ(positions.front().z(), z) << frame;
  }
}

TEST_F(Gltf, keys_at_added_up_times_are_frames) {
  for (const std::size_t keys : {101U, 3001U}) {
    auto sample = square_gltf();
    std::string times, sizes;
    float time = 0;
    for (std::size_t i = 0; i < keys; ++i, time += 1 / 24.0F) {
      times += packed<float>({time});
      sizes += packed<float>({double(i), 1, 1});
    }
    const auto accessor = [&](const std::string& bytes, const char* type) {
      return sample.add_accessor(
          {{"bufferView", sample.add_view(bytes)}, {"componentType", 5126}, {"count", keys}, {"type", type}});
    };
    const auto input = accessor(times, "SCALAR"), output = accessor(sizes, "VEC3");
    sample.animate(0, "scale", input, output, "STEP");
    const auto animation = read_animation(write(sample));
    ASSERT_EQ(animation.motion.frames, keys);
    EXPECT_NEAR(animation.frames_per_second, 24, 0.01);
    std::vector<Point> positions(animation.vertices);
    for (std::size_t frame = 0; frame < keys; ++frame) {
      animation.motion.pose(frame, positions);
      EXPECT_EQ(positions[1].x(), static_cast<double>(frame));
    }
  }
}

TEST_F(Gltf, an_end_that_was_rounded_down_is_a_frame) {
  const auto frames = [&](double end) {
    auto sample = square_gltf();
    sample.animate(0, "translation", sample.add_numbers({0, end}), sample.add_points({0, 0, 0, 0, 0, 1}));
    return read_animation(write(sample), {.frames_per_second = 30}).motion.frames;
  };
  EXPECT_EQ(frames(33.3332), 1001U) << "0.004 of a frame too early";
  EXPECT_EQ(frames(33.3328), 1000U) << "0.016 of a frame too early";
}

TEST_F(Gltf, animations_are_chosen_by_index_or_name) {
  auto sample = square_gltf();
  sample.animate(0, "translation", sample.add_numbers({0, 1}), sample.add_points({0, 0, 0, 0, 0, 1}));
  auto second = sample.json["animations"][0];
  second["name"] = "run";
  second["samplers"][0]["output"] = sample.add_points({0, 0, 5, 0, 0, 6});
  sample.json["animations"].push_back(second);
  const auto file = write(sample);
  std::vector<Point> positions(4);
  for (const auto& options :
       {Gltf_motion_options{.animation = std::size_t{1}}, Gltf_motion_options{.animation = "run"}}) {
    read_gltf_motion(file, 4, options).pose(0, positions);
    EXPECT_EQ(positions[0], Point(0, 0, 5));
  }
  EXPECT_THROW(read_gltf_motion(file, 4, {.animation = "fly"}), Bad_motion);
  EXPECT_THROW(read_gltf_motion(file, 4, {.animation = std::size_t{2}}), Bad_motion);
  EXPECT_THROW(read_gltf_motion(file, 5), Bad_motion);
  EXPECT_THROW(read_gltf_motion(write(square_gltf()), 4), Bad_motion);
  EXPECT_THROW(read_gltf_motion(file, 4).pose(31, positions), Bad_motion);
}

TEST_F(Gltf, an_unknown_animation_is_refused_with_the_names_that_there_are) {
  auto sample = square_with_two_animations();
  sample.json["animations"][1].erase("name");
  const auto error = message_of<Bad_motion>([&] { read_animation(write(sample), {.animation = "fly"}); });
  EXPECT_NE(error.find("there is no animation 'fly', the file has 'idle', 1"), std::string::npos) << error;
}

TEST_F(Gltf, a_motion_names_the_animations_of_its_file) {
  const auto file = write(square_with_two_animations());
  for (const std::size_t number : {0, 1}) {
    const auto animations = read_animation(file, {.animation = number}).motion.animations;
    EXPECT_EQ(animations.names, (std::vector<std::string>{"idle", "walk"}));
    EXPECT_EQ(animations.played, number);
  }
}

}  // namespace
}  // namespace lodestone::test
