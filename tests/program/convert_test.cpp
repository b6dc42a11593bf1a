// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "lodestone/io/motion/animation.h"
#include "lodestone/io/motion/point_cache.h"
#include "lodestone/io/results/animation_output.h"
#include "program/run_program.h"
#include "support/gltf_samples.h"
#include "support/mesh_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

class Convert : public testing::Test {
 protected:
  Convert() {
    folder.write("square.off", square_off);
    for (int frame = 0; frame < 12; ++frame) {
      auto bytes = square_off;
      folder.write("f" + std::to_string(frame) + ".off",
                   bytes.replace(bytes.find("1 1 0"), 5, "1 1 " + std::to_string(frame) + ".25"));
    }
  }
  std::string path(const std::string& name) const { return (folder.path() / name).string(); }
  void convert(const std::string& from, const std::string& to, const std::vector<std::string>& options = {}) const {
    std::vector<std::string> arguments{"convert", path(from), path(to), "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expect_success(run_program(arguments));
  }
  /// Height of the square's third corner in each frame.
  std::vector<double> heights(const std::string& name) const {
    const auto animation = read_animation(path(name));
    std::vector<Point> positions(animation.vertices);
    std::vector<double> result;
    for (std::size_t frame = 0; frame < animation.motion.frames; ++frame) {
      animation.motion.pose(frame, positions);
      result.push_back(positions[2].z());
    }
    return result;
  }

  Temporary_folder folder;
  const std::vector<double> all{0.25, 1.25, 2.25, 3.25, 4.25, 5.25, 6.25, 7.25, 8.25, 9.25, 10.25, 11.25};
};

TEST_F(Convert, round_trips_through_every_format) {
  convert("f*.off", "a.pc2");
  convert("a.pc2", "a.mdd");
  convert("a.mdd", "a.glb", {"--mesh", path("square.off")});
  convert("a.glb", "b.gltf", {"--fps", "30"});
  convert("b.gltf", "out/g####.ply");
  convert("out/g####.ply", "out/h*.obj");
  for (const auto* name : {"a.pc2", "a.mdd", "a.glb", "b.gltf", "out/g*.ply", "out/h*.obj"})
    EXPECT_EQ(heights(name), all) << name;
}

TEST_F(Convert, writes_only_the_requested_frames) {
  const auto expect_frames = [&](const std::string& choice, const std::vector<double>& expected) {
    convert("f*.off", "a.pc2", {"--frames", choice});
    EXPECT_EQ(heights("a.pc2"), expected) << choice;
  };
  expect_frames("2:4", {2.25, 3.25, 4.25});
  expect_frames("::5", {0.25, 5.25, 10.25});
  expect_frames("9:", {9.25, 10.25, 11.25});
  expect_frames(":1", {0.25, 1.25});
  expect_frames("3", {3.25});
  expect_frames("1:11:18446744073709551615", {1.25});
  for (const auto* choice : {"5:4", "0:12", "12", "::0", "a", "1:2:3:4", "-1", "1.5", ""})
    expect_error(run_program({"convert", path("f*.off"), path("b.pc2"), "--frames", choice}), 2, "");
  EXPECT_FALSE(exists(folder.path() / "b.pc2"));
}

TEST_F(Convert, keeps_the_duration) {
  convert("f*.off", "a.mdd", {"--fps", "60", "--frames", "::2"});
  EXPECT_NEAR(read_point_cache_header(path("a.mdd")).frames_per_second, 30, 1e-3);
  convert("a.mdd", "b.mdd");
  EXPECT_NEAR(read_point_cache_header(path("b.mdd")).frames_per_second, 30, 1e-3);
}

TEST_F(Convert, keeps_when_the_first_frame_is) {
  write_animation(path("late.mdd"), read_animation(path("f*.off")), {.frames_per_second = 24, .start = 0.25});
  const auto start = [&](const std::string& name, const std::vector<std::string>& options) {
    convert("late.mdd", name, options);
    return read_animation(path(name)).motion.start;
  };
  EXPECT_NEAR(start("a.mdd", {}), 0.25, 1e-6);
  EXPECT_NEAR(start("a.glb", {"--mesh", path("square.off")}), 0.25, 1e-6);
  EXPECT_NEAR(start("b.mdd", {"--scale", "2", "--frames", "::2"}), 0.25, 1e-6);
  EXPECT_NEAR(start("c.mdd", {"--fps", "48"}), 0.125, 1e-6);
  EXPECT_EQ(start("d.mdd", {"--frames", "1:"}), 0);
  EXPECT_EQ(heights("a.glb"), all);
}

TEST_F(Convert, keeps_the_time_of_a_single_frame) {
  write_animation(path("one.mdd"), read_animation(path("f3.off")), {.start = 2.5});
  EXPECT_EQ(read_animation(path("one.mdd")).motion.start, 2.5);
  convert("one.mdd", "a.mdd");
  EXPECT_EQ(read_bytes(path("a.mdd")), read_bytes(path("one.mdd")));
}

TEST_F(Convert, times_that_floats_do_not_tell_well_are_refused) {
  write_animation(path("late.mdd"), read_animation(path("f*.off")), {.frames_per_second = 30, .start = 1e6});
  const auto refused = run_program({"convert", path("late.mdd"), path("a.glb"), "--mesh", path("square.off")});
  expect_error(refused, 2, "frames 0 and 1 would be 0.0625 s apart, not 0.0333");
  EXPECT_THROW(write_animation(path("a.glb"), read_animation(path("f*.off")), {.frames_per_second = 1e-40}),
               Bad_argument);
  EXPECT_FALSE(std::filesystem::exists(path("a.glb")));
}

TEST_F(Convert, says_where_differences_to_the_first_frame_are_coarse) {
  const auto square_at = [](const std::string& x) {
    return "OFF\n3 1 0\n" + x + ".25 0 0\n" + x + ".5 0 0\n" + x + ".25 0.3 0\n3 0 1 2\n";
  };
  folder.write("t0.off", square_at("1000000"));
  folder.write("t1.off", "OFF\n3 1 0\n0.1 0 0\n0.3 0 0\n0.1 0.3 0\n3 0 1 2\n");
  const std::string said = "coordinates are rounded to floats";
  EXPECT_NE(run_program({"convert", path("t*.off"), path("t.glb")}).err.find(said), std::string::npos);
  EXPECT_EQ(run_program({"convert", path("t*.off"), path("t.glb"), "--frames", "1:"}).err.find(said),
            std::string::npos);
}

TEST_F(Convert, a_motion_that_overflows_is_an_error) {
  folder.write("scene.json", R"({"frames": 3, "objects": [{"name": "sheet", "mesh": "square.off",
    "place": {"scale": 1e308}, "motion": {"deform": [{"travel": {"path": "linear",
      "way_points": [{"frame": 0, "at": [0, 0, 0]}, {"frame": 2, "at": [1.7e308, 0, 0]}]}}]}}]})");
  const auto refused = run_program({"convert", path("scene.json#sheet"), path("a_#.obj")});
  expect_error(refused, 3, "is not finite");
  EXPECT_FALSE(std::filesystem::exists(path("a_0.obj")));
}

TEST_F(Convert, keeps_the_rate_of_an_object_of_a_scene) {
  convert("f*.off", "a.mdd", {"--fps", "24"});
  folder.write("scene.json", R"({"objects": [{"name": "sheet", "mesh": "square.off", "motion": {"mdd": "a.mdd"}}]})");
  convert("scene.json#sheet", "b.mdd");
  EXPECT_NEAR(read_point_cache_header(path("b.mdd")).frames_per_second, 24, 1e-3);
}

TEST_F(Convert, samples_gltf_at_any_rate) {
  folder.write("a.glb", rich_gltf().glb());
  convert("a.glb", "a.pc2");
  EXPECT_EQ(read_point_cache_header(path("a.pc2")).frames, 61U);
  convert("a.glb", "a.pc2", {"--fps", "10"});
  EXPECT_EQ(read_point_cache_header(path("a.pc2")).frames, 21U);
}

TEST_F(Convert, says_which_animation_of_gltf_it_takes) {
  folder.write("walk.glb", square_with_two_animations().glb());
  const auto result = run_program({"convert", path("walk.glb"), path("a.glb")});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err,
            "lodestone: walk.glb: plays the animation 'idle', the first of 2: 'idle', 'walk'; `gltf.animation` of a "
            "scene chooses another\n");
  convert("walk.glb", "b.glb");
}

TEST_F(Convert, says_how_to_get_the_faces_that_a_point_cache_does_not_keep) {
  folder.write("walk 2.glb", square_gltf().glb());
  for (const std::string name : {"a.pc2", "a.mdd"}) {
    const auto result = run_program({"convert", path("walk 2.glb"), path(name)});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err, "lodestone: " + path(name) +
                              ": faces are not kept: a point cache has none; convert to a mesh file, such as "
                              ".obj, too, with --frames 0\n");
  }
  convert("walk 2.glb", "a.off", {"--frames", "0"});
  EXPECT_EQ(read_animation(path("a.off")).faces, read_animation(path("walk 2.glb")).faces);
  const auto mesh = path("a.off");
  expect_success(run_program({"convert", path("a.pc2"), path("b.mdd")}));
  expect_success(run_program({"convert", path("a.pc2"), path("b.mdd"), "--mesh", mesh}));
  const auto edited = run_program({"convert", path("a.pc2"), path("b.mdd"), "--mesh", mesh, "--subdivide", "2"});
  EXPECT_NE(edited.err.find("faces are not kept"), std::string::npos) << edited.err;
  expect_success(run_program({"convert", mesh, path("c.pc2")}));
}

TEST_F(Convert, notes_that_slow_gltf_is_sampled_anew) {
  const std::string note = path("slow.glb") + ": Lodestone reads glTF with fewer than 5 frames per second at 30";
  for (const auto& [rate, noted] : {std::pair("4", true), {"5", false}}) {
    const auto result = run_program({"convert", path("f*.off"), path("slow.glb"), "--fps", rate});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err.find(note) != std::string::npos, noted) << result.err;
  }
}

TEST_F(Convert, names_the_one_numbered_file_that_it_has_written) {
  const auto one = run_program({"convert", path("f*.off"), path("one_##.obj"), "--frames", "0"});
  EXPECT_EQ(one.exit_code, 0);
  EXPECT_EQ(one.out, path("one_00.obj") + ": 1 frame of 4 vertices\n");
}

TEST_F(Convert, counts_the_files_of_an_earlier_run_that_match_the_pattern) {
  const auto out = path("h/q_#.obj");
  expect_success(run_program({"convert", path("f*.off"), out}));
  const auto shorter = run_program({"convert", path("f*.off"), out, "--frames", "0:1"});
  EXPECT_EQ(shorter.exit_code, 0);
  EXPECT_EQ(shorter.err, "lodestone: " + out + ": 10 other files match; they were there before\n");
  const auto longer = run_program({"convert", path("f*.off"), out, "--frames", "0:10"});
  EXPECT_EQ(longer.err, "lodestone: " + out + ": 1 other file matches; it was there before\n");
  expect_success(run_program({"convert", path("f*.off"), out}));
  expect_success(run_program({"convert", path("f*.off"), out, "--frames", "0", "--quiet"}));
}

TEST_F(Convert, names_both_files_of_a_gltf) {
  const auto result = run_program({"convert", path("f*.off"), path("two.gltf")});
  EXPECT_EQ(result.out, path("two.gltf") + " and " + path("two.bin") + ": 12 frames of 4 vertices\n");
}

TEST_F(Convert, colours_regions) {
  convert("f*.off", "a.gltf", {"--regions", "2"});
  const auto json = read_json(path("a.gltf"));
  EXPECT_TRUE(json["meshes"][0]["primitives"][0]["attributes"].contains("COLOR_0"));
  EXPECT_EQ(heights("a.gltf"), all);
}

TEST_F(Convert, refuses_contradictory_arguments) {
  convert("f*.off", "a.pc2");
  expect_error(run_program({"convert", path("a.pc2"), path("a.glb")}), 2, "--mesh");
  expect_error(run_program({"convert", path("a.pc2"), path("a.mdd"), "--regions", "2"}), 2, "--regions");
  expect_error(run_program({"convert", path("f*.off"), path("a#.ply"), "--regions", "2"}), 2, "--regions");
  expect_error(run_program({"convert", path("f*.off"), path("a.off")}), 2, "12 frames need a pattern");
  expect_error(run_program({"convert", path("f*.off"), path("a.xyz")}), 2, "a.xyz");
  expect_error(run_program({"convert", path("f*.off"), path("square.off/a.pc2")}), 4, "square.off");
  expect_error(run_program({"convert", path("g*.off"), path("b.pc2")}), 3, "no file matches this");
  remove(folder.path() / "f7.off");
  expect_error(run_program({"convert", path("f*.off"), path("b.pc2")}), 3, "f7.off");
  expect_error(run_program({"convert", path("f*.off")}), 2, "");
  EXPECT_FALSE(exists(folder.path() / "b.pc2"));
  EXPECT_FALSE(exists(folder.path() / "a.glb"));
}

TEST_F(Convert, refusals_of_edits_name_the_option_or_the_input) {
  const std::vector<std::vector<std::string>> wrong{{"--weld", "nan"},  {"--weld", "-1"},   {"--weld", "inf"},
                                                    {"--scale", "nan"}, {"--scale", "0"},   {"--scale", "-1"},
                                                    {"--scale", "inf"}, {"--scale", "half"}};
  for (const auto& edit : wrong) {
    SCOPED_TRACE(edit[0] + " " + edit[1]);
    expect_error(run_program({"convert", path("f1.off"), path("a.off"), edit[0], edit[1]}), 2, edit[0] + ": ");
  }
  expect_error(run_program({"convert", path("f1.off"), path("a.off"), "--weld", "1000"}), 2,
               path("f1.off") + ": welding leaves no face");
  expect_error(run_program({"convert", "", path("a.off")}), 2, "IN: expected a name");
  EXPECT_FALSE(exists(folder.path() / "a.off"));
}

TEST_F(Convert, never_overwrites_its_input_whatever_its_name) {
  for (const auto* name : {"m#1.glb", "m*.glb", "m##.pc2", "x*y#.mdd", "m#1.gltf"}) {
    SCOPED_TRACE(name);
    expect_success(run_program({"convert", "shape:teapot", path(name), "--quiet"}));
    const std::string before = read_bytes(path(name));
    expect_error(run_program({"convert", path(name), path(name), "--scale", "2"}), 2, "never overwritten");
    EXPECT_EQ(read_bytes(path(name)), before);
  }
}

TEST_F(Convert, an_error_in_a_later_frame_leaves_no_result) {
  folder.write("f8.off", "OFF\n");
  for (const auto* name : {"out/a.pc2", "out/a.mdd", "out/a.glb", "out/a.gltf", "out/a#.obj"})
    expect_error(run_program({"convert", path("f*.off"), path(name)}), 3, "f8.off");
  EXPECT_EQ(content_of(folder.path() / "out"), std::set<std::string>{});
}

}  // namespace
}  // namespace lodestone::test
