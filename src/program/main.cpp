// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "lodestone/version.h"
#include "program/command_line.h"
#include "program/commands.h"
#include "program/common_options.h"
#include "program/detect_options.h"
#include "program/exit_codes.h"
#include "program/run_reported.h"
#include "program/shard_options.h"
#include "program/standard_input.h"
#include "program/strategy_options.h"

namespace lodestone {

namespace {

void add_partition(CLI::App& program, Partition_command& command, std::string& format) {
  auto& app = *program.add_subcommand("partition", "Divide a mesh into regions");
  app.add_option("MESH", command.mesh,
                 "Mesh (.off .obj .ply .stl .gltf .glb .md2 .md3), MESH+CACHE with .pc2 or .mdd, SCENE.json#OBJECT, "
                 "shape:teapot; of an animation the first frame; - is the standard input")
      ->required()
      ->type_name("FILE")
      ->check(not_empty());
  app.add_option("--regions", command.regions, "Number of regions")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000}))
      ->capture_default_str();
  add_reading(app, command.reading);
  add_strategy_options(app, command.strategy, "Seed, for random strategies");
  add_threads(app, command.strategy.settings.lbg.threads,
              "Maximum number of threads, for lbg and its variants; 0: all of the machine");
  add_keep_islands(app, command.options);
  app.add_option("--out", command.out, "Coloured mesh (.ply)")->type_name("FILE")->check(not_empty());
  app.add_option("--json", command.json, "Statistics, and the region of each vertex")
      ->type_name("FILE")
      ->check(not_empty());
  add_html(app, command.html, "Page (.html) that shows the regions");
  app.add_flag("--quiet", command.quiet, "No table");
  add_format(app, format);
  app.footer(strategy_list() + "\n\n" + exit_code::help);
}

void add_info(CLI::App& program, Info_command& command, std::string& format) {
  auto& app = *program.add_subcommand("info", "Report the contents of a file, and possible problems");
  app.add_option("FILE", command.file,
                 "Mesh, pattern such as 'cloth_*.obj', point cache (.pc2 .mdd), MESH+CACHE, glTF, scene, "
                 "SCENE.json#OBJECT, shape:teapot; - is the standard input")
      ->required()
      ->type_name("FILE")
      ->check(not_empty());
  app.add_option("--mesh", command.mesh, "The mesh that a point cache moves")->type_name("FILE")->check(not_empty());
  app.add_flag("--json", command.json, "Print JSON");
  add_reading(app, command.reading);
  add_format(app, format);
}

void add_convert(CLI::App& program, Convert_command& command, std::string& format) {
  auto& app = *program.add_subcommand("convert", "Convert between formats of meshes and animations");
  app.add_option("IN", command.input,
                 "Mesh, pattern such as 'cloth_*.obj', point cache (.pc2 .mdd), MESH+CACHE, glTF, SCENE.json#OBJECT, "
                 "shape:teapot; - is the standard input")
      ->required()
      ->type_name("FILE")
      ->check(not_empty());
  app.add_option("OUT", command.output, "Point cache, glTF (.gltf .glb), mesh or pattern such as 'out/cloth_####.ply'")
      ->required()
      ->type_name("FILE")
      ->check(not_empty());
  app.add_option("--mesh", command.mesh, "The mesh that a point cache moves")->type_name("FILE")->check(not_empty());
  app.add_option("--frames", command.frames, "FIRST:LAST:STEP, counted from 0, LAST included; each may be omitted")
      ->type_name("FRAMES")
      ->check(not_empty());
  app.add_option("--fps", command.rate, "Frames per second, for reading glTF and writing glTF and MDD")
      ->check(finite_number(1e-3, 1e6, "0.001 to 1e6"))
      ->default_str("what IN says, else 30");
  app.add_option("--regions", command.regions, "glTF: divide the surface into this many regions and colour them")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000}));
  app.add_flag_callback(
      "--triangulate", [] {}, "Cut faces of more than three corners into triangles; done whether given or not");
  app.add_option("--weld", command.weld, "Merge vertices that are at most so far apart in the first frame")
      ->type_name("DISTANCE")
      ->check(finite_number(0, std::numeric_limits<double>::max(), "0 or more"));
  app.add_option("--subdivide", command.subdivisions, "Cut every triangle into four, so many times")
      ->check(CLI::Range(std::size_t{0}, std::size_t{12}));
  app.add_option("--scale", command.scale, "Multiply all coordinates")
      ->type_name("FACTOR")
      ->check(number_above_0(false));
  app.add_flag("--quiet", command.quiet, "No progress bar, no report");
  add_reading(app, command.reading);
  add_format(app, format);
}

/// All commands. The command line fills in one of them.
struct Commands {
  Detect_command detect = {};
  Partition_command partition = {};
  Info_command info = {};
  Convert_command convert = {};
  Status_command status = {};
  Submit_command submit = {};
  Merge_command merge = {};
  std::string format = {};  ///< of the mesh on the standard input
};

void add_commands(CLI::App& program, Commands& commands) {
  program.name("lodestone");
  program.set_version_flag("--version", "lodestone " + std::string(version()));
  program.set_help_all_flag("--help-all", "Show the help of all commands");
  program.require_subcommand(1);
  program.footer(exit_code::help);
  add_detect(program, commands.detect, commands.format);
  add_partition(program, commands.partition, commands.format);
  add_info(program, commands.info, commands.format);
  add_convert(program, commands.convert, commands.format);
  add_submit(program, commands.submit);
  add_status(program, commands.status);
  add_merge(program, commands.merge);
  // Registered for the help only: the program of the experiments parses its arguments.
  program.add_subcommand("experiment", "Run one of the experiments, see lodestone experiment --help")
      ->prefix_command()
      ->set_help_flag();
}

/// The inputs that may be the standard input.
std::vector<std::filesystem::path*> inputs_of(Commands& commands) {
  std::vector<std::filesystem::path*> inputs{&commands.partition.mesh, &commands.info.file, &commands.convert.input};
  for (auto& input : commands.detect.inputs) inputs.push_back(&input);
  return inputs;
}

/// How the command that the command line asks for reads.
const Scene_options& reading_of(const std::string& name, const Commands& commands) {
  if (name == "partition") return commands.partition.reading;
  if (name == "info") return commands.info.reading;
  return name == "convert" ? commands.convert.reading : commands.detect.reading;
}

int run_commands(int argc, char** argv);

int run_detect(const CLI::App& app, Detect_command& command, const std::vector<std::string>& words) {
  complete(app, command);
  command.words = words_of_work(words);
  return run(command);
}

int run_partition(const CLI::App& app, const Partition_command& command) {
  refuse_allow_outside(app, {command.mesh});
  refuse_options_of_other_strategies(app, command.strategy.name, true);
  return run(command);
}

int run_info(const CLI::App& app, const Info_command& command) {
  refuse_allow_outside(app, {command.file});
  return run(command);
}

int run_convert(const CLI::App& app, const Convert_command& command) {
  refuse_allow_outside(app, {command.input});
  return run(command);
}

/// Runs the command that has made the shards once more, to merge them.
int run_merge(const Merge_command& command) {
  auto words = merging_words(command);
  std::vector<char*> pointers;
  for (auto& word : words) pointers.push_back(word.data());
  if (words[1] == "experiment") run_experiments({pointers.begin() + 2, pointers.end()});
  return run_commands(static_cast<int>(pointers.size()), pointers.data());
}

/// @param app  the command that the command line asks for
int run_command(const CLI::App& app, Commands& commands, int argc, char** argv) {
  const std::string& name = app.get_name();
  if (name == "detect") return run_detect(app, commands.detect, {argv + 1, argv + argc});
  if (name == "partition") return run_partition(app, commands.partition);
  if (name == "info") return run_info(app, commands.info);
  if (name == "convert") return run_convert(app, commands.convert);
  if (name == "submit") return run(commands.submit);
  if (name == "status") return run(commands.status);
  if (name == "merge") return run_merge(commands.merge);
  run_experiments({argv + 2, argv + argc});
}

int run_commands(int argc, char** argv) {
  CLI::App program("lodestone: collision detection for triangle meshes that deform");
  Commands commands;
  add_commands(program, commands);
  if (const auto done = parse(program, argc, argv)) return *done;
  const CLI::App& asked = *program.get_subcommands().front();
  std::optional<Standard_input> standard_input;
  replace_standard_input(inputs_of(commands), commands.format, reading_of(asked.get_name(), commands).limits.max_bytes,
                         standard_input);
  return run_command(asked, commands, argc, argv);
}

}  // namespace

}  // namespace lodestone

int main(int argc, char** argv) {
  return lodestone::run_reported([&] { return lodestone::run_commands(argc, argv); });
}
