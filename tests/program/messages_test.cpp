// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "program/run_program.h"
#include "program/suggestion.h"
#include "support/mesh_samples.h"
#include "support/scene_samples.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

class Messages : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder.path() / name).string(); }
  static std::string complaint(const std::vector<std::string>& arguments) {
    const auto result = run_program(arguments);
    EXPECT_NE(result.exit_code, 0);
    return result.err;
  }

  Temporary_folder folder;
  const std::string mesh = folder.write("a.off", tetrahedron_off()).string();
};

TEST(Suggestion, is_the_nearest_word_if_it_is_near) {
  const std::vector<std::string> words{"--contacts", "--candidates", "--containment", "--self", "--seed"};
  EXPECT_EQ(suggestion_for("--contcts", words), "--contacts");
  EXPECT_EQ(suggestion_for("--contact", words), "--contacts");
  EXPECT_EQ(suggestion_for("--conatcts", words), "--contacts");
  EXPECT_EQ(suggestion_for("--slef", words), "--self");
  EXPECT_EQ(suggestion_for("--frobnicate", words), "");
  EXPECT_EQ(suggestion_for("", words), "");
}

TEST(Suggestion, counts_swapped_neighbours_as_one_edit) {
  EXPECT_EQ(edit_distance("abcd", "abdc"), 1U);
  EXPECT_EQ(edit_distance("abcd", "abcd"), 0U);
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
}

TEST_F(Messages, suggest_the_command_that_was_meant) {
  expect_error(run_program({"detcet", mesh, mesh}), 2, "there is no command detcet; did you mean detect?");
  expect_error(run_program({"frobnicate", mesh}), 2, "there is no command frobnicate (see");
}

TEST_F(Messages, suggest_the_option_that_was_meant) {
  expect_error(run_program({"detect", mesh, mesh, "--contact", "all"}), 2,
               "there is no option --contact; did you mean --contacts?");
  expect_error(run_program({"detect", mesh, mesh, "--treads=2"}), 2, "no option --treads; did you mean --threads?");
  expect_error(run_program({"convert", mesh, "--frame", "1"}), 2, "did you mean --frames?");
  expect_error(run_program({"experiment", "modes", "--onyl", "x"}), 2, "did you mean --only?");
}

TEST_F(Messages, about_a_missing_or_unknown_file_do_not_speak_of_one_mesh_alone) {
  const auto missing = complaint({"detect", path("scene.jsn")});
  EXPECT_NE(missing.find("scene.jsn: there is no such file"), std::string::npos) << missing;
  const auto unknown = complaint({"detect", folder.write("scene.jsn", "{}").string()});
  EXPECT_NE(unknown.find("found extension '.jsn'"), std::string::npos) << unknown;
  for (const auto& text : {missing, unknown}) EXPECT_EQ(text.find("alone"), std::string::npos) << text;
  EXPECT_NE(complaint({"detect", mesh}).find("alone"), std::string::npos);
  expect_error(run_program({"detect", folder.write("s.json", "{}").string(), mesh}), 2, "only input");
}

TEST_F(Messages, about_a_distance_name_its_option) {
  for (const std::string wrong : {"-1", "nan", "inf", "far"}) {
    expect_error(run_program({"detect", mesh, mesh, "--within", wrong}), 2,
                 "--within: not a finite number of 0 or more: " + wrong);
    expect_error(run_program({"detect", mesh, mesh, "--self", "--self-within", wrong}), 2, "--self-within: ");
  }
}

TEST_F(Messages, about_a_number_that_is_not_finite_or_not_in_its_range_name_its_option) {
  const auto cloth = path("b.obj");
  for (const std::string wrong : {"nan", "-nan", "inf", "-inf", "1e400", "1e7", "-1", "", "2x"}) {
    const std::string found = ": " + wrong;
    expect_error(run_program({"convert", mesh, cloth, "--fps", wrong}), 2,
                 "--fps: not a finite number of 0.001 to 1e6" + found);
    expect_error(run_program({"partition", mesh, "--normal-weight", wrong}), 2,
                 "--normal-weight: not a finite number of 0 to 1e6" + found);
    for (const std::string option : {"--time-factor", "--memory-factor"})
      expect_error(
          run_program({"submit", "--slurm", "--out", path("out"), "--dry-run", option, wrong, "--", "detect", mesh}), 2,
          option + ": not a finite number of 1 to 1000" + found);
  }
}

TEST_F(Messages, name_the_option_that_no_file_takes) {
  expect_error(run_program({"convert", mesh, path("b.obj"), "--fps", "50"}), 2,
               "b.obj: --fps needs a glTF file to read, or");
  expect_success(run_program({"convert", mesh, path("b.glb"), "--fps", "50"}));
  expect_success(run_program({"convert", mesh, path("b.mdd"), "--fps", "50", "--quiet"}));
  expect_success(run_program({"convert", path("b.glb"), path("c.obj"), "--fps", "50", "--quiet"}));
  const std::vector<std::vector<std::string>> without_scene{
      {"detect", mesh, "shape:teapot"}, {"info", mesh}, {"convert", mesh, path("d.obj")}};
  for (auto command : without_scene) {
    command.emplace_back("--allow-outside");
    expect_error(run_program(command), 2, "--allow-outside is for scenes: no input is one");
  }
}

TEST_F(Messages, about_a_whole_number_expect_decimal_digits_that_fit) {
  for (const char* number : {"010", "0x10", "18446744073709551616", "1e3"}) {
    const auto result = run_program({"detect", mesh, mesh, "--most-contacts", number, "--contacts", "all"});
    EXPECT_EQ(result.exit_code, 2) << number;
    EXPECT_NE(result.err.find("--most-contacts"), std::string::npos) << result.err;
  }
  expect_error(run_program({"partition", mesh, "--regions", "010"}), 2, "whole number in decimal digits, found '010'");
  expect_error(run_program({"partition", mesh, "--seed", "18446744073709551616"}), 2,
               "--seed: expected at most 18446744073709551615, found '18446744073709551616'");
}

TEST_F(Messages, about_a_shape_are_those_of_a_scene) {
  expect_error(run_program({"detect", mesh, "shape:kettle"}), 3,
               "shape:kettle: /: unknown key \"kettle\" (expected one");
}

TEST_F(Messages, about_a_frame_that_cannot_be_written_name_the_file) {
  const auto small = folder.write("small.off", "OFF\n3 1 0\n0 0 0\n1e-60 0 0\n0 1e-60 0\n3 0 1 2\n").string();
  expect_error(run_program({"convert", small, path("b.stl")}), 3, "b.stl: frame 0: its largest coordinate, 1e-60, is");
  const auto large = folder.write("large.off", "OFF\n3 1 0\n0 0 0\n1e60 0 0\n0 1 0\n3 0 1 2\n").string();
  expect_error(run_program({"convert", large, path("b.glb")}), 3,
               "b.glb: frame 0, vertex 1 (counted from 0): 1e+60 is");
}

TEST_F(Messages, name_the_option_that_the_mode_ignores_and_the_modes_that_take_it) {
  const auto detect = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"detect", mesh, mesh});
    return run_program(options);
  };
  expect_error(detect({"--mode", "particles", "--self"}), 2, "--self needs --mode exact");
  expect_error(detect({"--mode", "senin", "--within", "1"}), 2, "--within needs --mode exact");
  expect_error(detect({"--mode", "exact", "--collision-distance", "2"}), 2,
               "--collision-distance needs --mode particles or senin");
  expect_error(detect({"--mode", "senin", "--growth", "2"}), 2, "--growth needs --mode particles");
}

TEST_F(Messages, name_the_option_that_is_about_two_objects_where_there_is_one) {
  const std::vector<std::vector<std::string>> of_pairs{
      {"--within", "1"}, {"--containment"}, {"--parting"}, {"--closest"}, {"--truth"}};
  for (auto option : of_pairs) {
    const auto message = option[0] + " is about two objects, and there is one only";
    auto with_another = option;
    option.insert(option.begin(), {"detect", mesh, "--self"});
    expect_error(run_program(option), 2, message);
    with_another.insert(with_another.begin(), {"detect", mesh, mesh, "--self"});
    EXPECT_EQ(run_program(with_another).err.find(message), std::string::npos);
  }
  expect_error(run_program({"detect", mesh, "--self", "--within", "1"}), 2, "take --self-within");
}

TEST_F(Messages, say_that_a_mesh_is_named_already) {
  const std::vector<std::vector<std::string>> commands{{"info", "a.off+a.pc2"}, {"convert", "a.off+a.pc2", "b.pc2"}};
  for (auto command : commands) {
    command.insert(command.end(), {"--mesh", mesh});
    expect_error(run_program(command), 2, "a.off+a.pc2: names its mesh already, a.off");
  }
}

TEST_F(Messages, of_a_seed_tell_the_range_that_holds) {
  const auto detect = [&](const std::string& seed) { return run_program({"detect", mesh, mesh, "--seed", seed}); };
  expect_success(detect("18446744073709551615"));
  for (const auto* seed : {"-1", "18446744073709551616", "one"}) expect_error(detect(seed), 2, "--seed");
}

TEST_F(Messages, name_the_option_that_has_no_effect_with_meetings_or_without) {
  const auto detect = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"detect", mesh, mesh, "--mode", "particles"});
    return run_program(options);
  };
  const std::vector<std::vector<std::string>> published{{"--collision-distance", "2"}, {"--candidates", "closest"}};
  for (const auto& option : published) {
    expect_error(detect(option), 2, option[0] + " has no effect with meetings: add --meetings 0");
    expect_success(detect({option[0], option[1], "--meetings", "0"}));
  }
  const std::vector<std::vector<std::string>> of_meetings{{"--opening-budget", "9"}, {"--opening-reach", "2"}};
  for (const auto& option : of_meetings) {
    expect_error(detect({option[0], option[1], "--meetings", "0"}), 2, option[0] + " has no effect with --meetings 0");
    expect_success(detect(option));
  }
}

TEST_F(Messages, of_convert_name_the_option_to_use) {
  const auto cache =
      folder.write("a.pc2", std::string("POINTCACHE2\0", 12) + packed<std::int32_t>({1, 1}) + packed<float>({0, 1}) +
                                packed<std::int32_t>({1}) + packed<float>({0, 0, 0}));
  expect_error(run_program({"convert", cache.string(), path("a.glb")}), 2, "--mesh");
  for (int frame = 0; frame < 8; ++frame) folder.write("f" + std::to_string(frame) + ".off", square_off);
  expect_error(run_program({"convert", path("f*.off"), path("b.pc2"), "--frames", "5:2"}), 2,
               "--frames 5:2: the range is empty");
  expect_error(run_program({"convert", path("f*.off"), path("b.pc2"), "--frames", "5:9"}), 2, "the frames are 0 to 7");
}

TEST_F(Messages, of_an_experiment_list_the_names_that_exist) {
  folder.write("one.json", "{}");
  folder.write("two.json", "{}");
  expect_error(run_program({"experiment", "every_frame", "--scenes", folder.path().string(), "--only", "sphere",
                            "--out", path("out")}),
               3, "the scenes are one, two");
  expect_error(run_program({"experiment", "partitions", "--only", "sphere", "--out", path("out")}), 2,
               "the meshes are ");
}

TEST_F(Messages, name_the_experiments_that_take_an_option) {
  expect_error(run_program({"experiment", "scaling", "--only", "sphere"}), 2, "the experiment scaling ignores --only");
  expect_error(run_program({"experiment", "scaling", "--jobs", "2"}), 2, "which is for partitions");
}

}  // namespace
}  // namespace lodestone::test
