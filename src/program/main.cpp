// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "io/files/small_text.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/version.h"
#include "program/command_line.h"
#include "program/commands.h"
#include "program/exit_codes.h"
#include "program/mode_options.h"
#include "program/run_reported.h"
#include "program/shard_options.h"
#include "program/standard_input.h"
#include "program/strategy_options.h"

namespace lodestone {

namespace {

/// Converts a name to its value, which CLI11 expects as a number.
template <class Value>
CLI::Validator one_of(const std::map<std::string, Value>& names) {
  std::vector<std::string> choices;
  for (const auto& entry : names) choices.push_back(entry.first);
  return {[names](std::string& text) -> std::string {
            const auto found = names.find(CLI::detail::to_lower(text));
            if (found == names.end()) {
              std::vector<std::string> expected;
              expected.reserve(names.size());
              for (const auto& entry : names) expected.push_back(entry.first);
              return fmt::format("expected {}, found '{}'", fmt::join(expected, " or "), text);
            }
            text = std::to_string(static_cast<int>(found->second));
            return {};
          },
          "", choices_name(choices)};
}

/// Limits the weight so that squared weighted vectors cannot overflow.
constexpr double largest_normal_weight = 1e6;

/// The strategies, with a summary of each.
std::string strategy_list() {
  std::string list = "Strategies:";
  for (const auto& strategy : strategies()) list += fmt::format("\n  {:<16} {}", strategy.name, strategy.summary);
  return list;
}

void add_strategy_options(CLI::App& app, Strategy_choice& choice, const char* seed_of) {
  std::vector<std::string> names;
  for (const auto& strategy : strategies()) names.emplace_back(strategy.name);
  app.add_option("--strategy", choice.name, "Partition strategy, see below")
      ->type_name("NAME")
      ->check(one_word_of(names))
      ->capture_default_str();
  app.add_option("--seed", choice.settings.seed, seed_of)
      ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()).description("0 or more"))
      ->capture_default_str();
  auto& options = choice.settings.lbg;
  app.add_option("--normal-weight", options.features.normal_weight,
                 "Weight of normals relative to positions; 0: positions only")
      ->check(finite_number(0, largest_normal_weight, "0 to 1e6"))
      ->capture_default_str();
  app.add_option("--split", options.split_rule, "How a code vector is split: principal_axis, multiplicative")
      ->transform(one_of<Split>({{"principal_axis", Split::principal_axis}, {"multiplicative", Split::multiplicative}}))
      ->type_name("RULE")
      ->default_str("principal_axis");
  app.add_option("--epsilon", options.split, "e of the split (1 + e)C, (1 - e)C")->capture_default_str();
  app.add_option("--lbg-tolerance", options.tolerance, "LBG: relative drop of the distortion at which iterations stop")
      ->capture_default_str();
  app.add_option("--lbg-sample", options.sample,
                 "LBG: maximum number of vertices to train on, but at least 128 per region; 0: all")
      ->check(CLI::Range(std::size_t{0}, std::size_t{1'000'000'000}))
      ->capture_default_str();
}

CLI::Validator distance_check() { return finite_number(0, std::numeric_limits<double>::max(), "0 or more"); }

void add_exact_options(CLI::App& app, Exact_options& options) {
  app.add_option("--within", options.tolerance,
                 "Modes exact and certified: report face pairs nearer than this, and which objects are near; 0: faces "
                 "that intersect")
      ->check(distance_check())
      ->capture_default_str();
  auto* const self = app.add_flag("--self", options.self_collision,
                                  "Modes exact and certified: also report an object's faces that intersect each other");
  app.add_option("--self-within", options.self_tolerance,
                 "With --self: also report an object's faces nearer than this, unless they share a vertex or "
                 "were nearer than twice this in the first frame; 0: faces that intersect")
      ->needs(self)
      ->check(distance_check())
      ->capture_default_str();
  app.add_flag("--containment", options.containment,
               "Modes exact and certified: also report objects that lie inside others");
  app.add_flag("--parting", options.parting,
               "Modes exact and certified: also report how to move one of two objects so that they collide no more, "
               "and neither lies inside the other");
  app.add_flag("--patches", options.patches,
               "Modes exact and certified: also group the face pairs of an object pair by the connected places in "
               "which faces meet");
}

void add_format(CLI::App& app, std::string& format) {
  app.add_option("--format", format, "Format of the mesh on the standard input (-): off, obj, ply, stl, glb, md2, md3")
      ->check(one_word_of({"off", "obj", "ply", "stl", "glb", "md2", "md3"}))
      ->type_name("NAME");
}

void add_max_faces(CLI::App& app, Mesh_file_options& limits) {
  app.add_option("--max-faces", limits.max_faces, "Refuse files with more faces, before memory is taken for them")
      ->check(CLI::Range(std::size_t{1}, Mesh_file_options().max_faces))
      ->type_name("N")
      ->capture_default_str();
}

void add_reading(CLI::App& app, Scene_options& reading) {
  app.add_flag("--allow-outside", reading.allow_outside, "A scene may name files outside its folder");
  add_max_faces(app, reading.limits);
}

void add_threads(CLI::App& app, std::size_t& threads, const char* of) {
  app.add_option("--threads", threads, of)->check(CLI::Range(std::size_t{0}, std::size_t{1024}))->capture_default_str();
}

void add_inputs(CLI::App& app, Detect_command& command) {
  app.add_option(
         "INPUT", command.inputs,
         "A scene (.json), or two or more meshes or animations (.off .obj .ply .stl .gltf .glb .md2 .md3, a "
         "pattern such as 'cloth_*.obj', MESH+CACHE with .pc2 or .mdd, SCENE.json#OBJECT, shape:teapot); one with "
         "--self, --components or --parts; - is the standard input")
      ->required()
      ->type_name("FILE");
  app.add_flag("--parts", command.parts,
               "Each part that a file names is an object of its own: an object of an OBJ file, a node of a glTF file");
  app.add_flag("--components", command.components,
               "Each connected component of a mesh is an object of its own, NAME_1, NAME_2 and so on");
}

void add_mode(CLI::App& app, Detector_options& options) {
  app.add_option("--mode", options.mode,
                 "exact: every face, misses nothing; certified: the same, reads only what is near; particles: one per "
                 "region, may miss; senin: the predecessor")
      ->transform(one_of<Mode>({{"particles", Mode::particles},
                                {"senin", Mode::senin},
                                {"exact", Mode::exact},
                                {"certified", Mode::certified}}))
      ->type_name("MODE")
      ->default_str("exact");
  app.add_option("--particles", options.particles,
                 "Particles per object; 0: the number of objects that can touch it at once, at least 12. Modes exact "
                 "and certified: regions at the top of its tree; 0: 12 with a strategy or a setting of it, else none")
      ->check(CLI::Range(std::size_t{0}, std::size_t{1'000'000}))
      ->capture_default_str();
}

void add_contact_options(CLI::App& app, Detect_command& command) {
  auto& options = command.options;
  app.add_option("--contacts", options.contacts, "What to report of a colliding pair: yes_no, first, all")
      ->transform(one_of<Contact_query>(
          {{"yes_no", Contact_query::yes_no}, {"first", Contact_query::first}, {"all", Contact_query::all}}))
      ->type_name("WHAT")
      ->default_str("first");
  app.add_option("--most-contacts", options.most_contacts,
                 "Maximum number of face pairs per object pair, with --contacts all")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000'000'000}).description("1 or more"))
      ->default_str("all");
  app.add_flag("--points", options.contact_points, "Also report the points where two faces meet");
  app.add_flag("--normals", options.contact_normals,
               "Also report the direction that separates two faces, and how far to move");
  app.add_flag("--closest", command.closest,
               "Modes exact and certified: also report the closest faces of each object pair, and their distance");
  app.add_flag("--impacts", command.impacts,
               "Mode exact: also report when object pairs meet first between a frame and the next, if every vertex "
               "moves on a straight line");
  app.add_flag("--truth", command.truth,
               "Compare every frame with exhaustive exact checking, for pairs of two objects; not for self-collisions");
}

void add_particle_options(CLI::App& app, Detector_options& options) {
  app.add_option(
         "--meetings", options.meetings,
         "Mode particles: maximum number of particle pairs per object pair that walk towards each other; 0: the "
         "published method, which checks regions whose particles are near")
      ->check(CLI::Range(std::size_t{0}, std::size_t{1'000'000}))
      ->capture_default_str();
  app.add_option(
         "--opening-budget", options.opening_budget,
         "Mode particles, with meetings: number of vertices that openings may read per object pair in a frame to "
         "look below the regions; regions with up to four times as many are read as a whole")
      ->check(CLI::Range(std::size_t{0}, std::size_t{1'000'000'000'000}).description("0 or more"))
      ->capture_default_str();
  app.add_option("--opening-reach", options.opening_reach,
                 "Mode particles, with meetings: parts of surfaces farther apart than this multiple of their radii are "
                 "not looked at")
      ->capture_default_str();
  app.add_option("--collision-distance", options.collision_distance,
                 "Mode senin, or particles with --meetings 0: particles nearer than this make their regions a "
                 "candidate; in mean edge lengths")
      ->capture_default_str();
  app.add_option("--candidates", options.candidates,
                 "Mode senin, or particles with --meetings 0: which of these candidates to check: all, closest")
      ->transform(one_of<Candidate_choice>({{"all", Candidate_choice::all}, {"closest", Candidate_choice::closest}}))
      ->type_name("WHICH")
      ->default_str("all");
  app.add_option(
         "--growth", options.growth,
         "Mode particles: repartition when a region exceeds this multiple of the largest initial area; inf: never")
      ->capture_default_str();
  app.add_flag_callback(
      "--open-seams", [&options] { options.close_seams = false; },
      "Mode particles or senin: do not join the border vertices that lie on each other in the first frame; particles "
      "then stop at seams");
}

void add_outputs(CLI::App& app, Detect_command& command) {
  app.add_option("--out", command.out, "Folder for frames.jsonl and summary.json")
      ->type_name("DIR")
      ->check(not_empty());
  auto* const html = add_html(app, command.html, "Page (.html) that shows the run; --contacts then defaults to all");
  app.add_option("--html-frames", command.html_frames,
                 "Maximum number of frames on the page: one of every few; 0: few enough to keep it small")
      ->needs(html)
      ->check(CLI::Range(std::size_t{0}, std::size_t{1'000'000}))
      ->capture_default_str();
  app.add_option("--paraview", command.paraview, "Folder for meshes.pvd, particles.pvd and contacts.pvd")
      ->type_name("DIR")
      ->check(not_empty());
  add_shard_options(app, command);
  app.add_flag("--all-rows", command.all_rows, "Print all rows of the table, not only the first 20");
  auto* const json = app.add_flag("--json", command.json, "Print the summary as JSON in place of the table");
  app.add_flag("--quiet", command.quiet, "No progress bar, one line in place of the table")->excludes(json);
  app.add_flag("--exit-code", command.exit_code, "Exit with 1 if anything collides, is near or meets");
}

void add_detect(CLI::App& program, Detect_command& command, std::string& format) {
  auto& app = *program.add_subcommand("detect", "Find collisions between meshes, or through all frames of a scene");
  add_inputs(app, command);
  add_mode(app, command.options);
  add_contact_options(app, command);
  add_particle_options(app, command.options);
  add_exact_options(app, command.options.exact);
  add_threads(app, command.options.exact.threads, "Maximum number of threads; 0: all of the machine");
  add_strategy_options(app, command.partition, "Seed, for random strategies and --mode senin");
  add_outputs(app, command);
  add_reading(app, command.reading);
  add_format(app, format);
  app.footer(strategy_list() + "\n\n" + exit_code::help);
}

void add_partition(CLI::App& program, Partition_command& command, std::string& format) {
  auto& app = *program.add_subcommand("partition", "Divide a mesh into regions");
  app.add_option("MESH", command.mesh,
                 "Mesh (.off .obj .ply .stl .gltf .glb .md2 .md3), SCENE.json#OBJECT, shape:teapot; - is the standard "
                 "input")
      ->required()
      ->type_name("FILE");
  app.add_option("--regions", command.regions, "Number of regions")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000}))
      ->capture_default_str();
  add_reading(app, command.reading);
  add_strategy_options(app, command.strategy, "Seed, for random strategies");
  add_threads(app, command.strategy.settings.lbg.threads, "Maximum number of threads, for lbg; 0: all of the machine");
  app.add_flag("--keep-islands", command.options.keep_islands, "Do not repair regions that consist of several islands");
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
                 "Mesh, pattern such as 'cloth_*.obj', point cache (.pc2 .mdd), glTF, scene, SCENE.json#OBJECT, "
                 "shape:teapot; - is the standard input")
      ->required()
      ->type_name("FILE");
  app.add_option("--mesh", command.mesh, "The mesh that a point cache moves")->type_name("FILE")->check(not_empty());
  app.add_flag("--json", command.json, "Print JSON");
  add_reading(app, command.reading);
  add_format(app, format);
}

void add_convert(CLI::App& program, Convert_command& command, std::string& format) {
  auto& app = *program.add_subcommand("convert", "Convert between formats of meshes and animations");
  app.add_option("IN", command.input,
                 "Mesh, pattern such as 'cloth_*.obj', point cache (.pc2 .mdd), glTF, SCENE.json#OBJECT, shape:teapot; "
                 "- is the standard input")
      ->required()
      ->type_name("FILE");
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
      ->type_name("DISTANCE");
  app.add_option("--subdivide", command.subdivisions, "Cut every triangle into four, so many times")
      ->check(CLI::Range(std::size_t{0}, std::size_t{12}));
  app.add_option("--scale", command.scale, "Multiply all coordinates")->type_name("FACTOR");
  app.add_flag("--quiet", command.quiet, "No progress bar, no report");
  add_reading(app, command.reading);
  add_format(app, format);
}

/// Refuses --allow-outside where no input is a scene, or an object of one.
/// @throws Bad_argument
void refuse_allow_outside(const CLI::App& app, const std::vector<std::filesystem::path>& inputs) {
  const auto is_of_a_scene = [](const std::filesystem::path& input) {
    return input.extension() == ".json" || input.string().find(".json#") != std::string::npos;
  };
  if (app.count("--allow-outside") > 0 && std::ranges::none_of(inputs, is_of_a_scene))
    throw Bad_argument("--allow-outside is for scenes: no input is one");
}

/// Refuses options of `detect` that it would ignore.
/// @throws Bad_argument  names the option
void refuse_options(const CLI::App& app, const Detect_command& command) {
  const auto& options = command.options;
  refuse_allow_outside(app, command.inputs);
  refuse_options_of_other_modes(app, options.mode);
  if (app.count("--most-contacts") > 0 && options.contacts != Contact_query::all)
    throw Bad_argument("--most-contacts needs --contacts all: otherwise one face pair is listed at most");
  // yes_no is refused by the detector.
  if (options.exact.patches && app.count("--contacts") > 0 && options.contacts == Contact_query::first)
    throw Bad_argument("contact patches need --contacts all: otherwise one face pair is listed at most");
  if (options.mode == Mode::particles) refuse_options_beside_meetings(app, options.meetings);
  refuse_options_of_other_strategies(app, command.partition.name, false);  // threads share frames too
}

/// Sets what follows from the options of `detect` that are given.
void set_defaults(const CLI::App& app, Detect_command& command) {
  auto& options = command.options;
  // Shards cannot know what earlier frames have done to the trees.
  command.independent_frames |= finds_all(options.mode) && (command.shard || command.merge_shards);
  command.chooses_strategy = chooses_strategy(app);
  // A user who chooses a strategy wants to see regions.
  if (finds_all(options.mode) && command.chooses_strategy && options.particles == 0)
    options.particles = options.least_particles;
  options.senin.seed = command.partition.settings.seed;
  command.partition.settings.lbg.threads = options.exact.threads;
}

/// Pages and patches show contacts, so they ask for all of them by default.
void set_default_contacts(const CLI::App& app, Detect_command& command) {
  if ((!command.html.empty() || command.options.exact.patches) && app.count("--contacts") == 0)
    command.options.contacts = Contact_query::all;
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

int run_commands(int argc, char** argv);

int run_detect(const CLI::App& app, Detect_command& command, const std::vector<std::string>& words) {
  set_default_contacts(app, command);
  refuse_options(app, command);
  set_defaults(app, command);
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
  std::optional<Standard_input> standard_input;
  replace_standard_input(inputs_of(commands), commands.format, standard_input);
  return run_command(*program.get_subcommands().front(), commands, argc, argv);
}

}  // namespace

}  // namespace lodestone

int main(int argc, char** argv) {
  return lodestone::run_reported([&] { return lodestone::run_commands(argc, argv); });
}
