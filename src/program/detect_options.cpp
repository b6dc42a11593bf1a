// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/detect_options.h"

#include <limits>

#include "lodestone/mesh/errors.h"
#include "program/command_line.h"
#include "program/common_options.h"
#include "program/exit_codes.h"
#include "program/mode_options.h"
#include "program/shard_options.h"
#include "program/strategy_options.h"

namespace lodestone {

namespace {

CLI::Validator distance_check() { return finite_number(0, std::numeric_limits<double>::max(), "0 or more"); }

void add_exact_options(CLI::App& app, Exact_options& options) {
  app.add_option(
         "--within", options.tolerance,
         "Modes exact and certified: report face pairs of two objects nearer than this, and which objects are near; "
         "0: faces that intersect")
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

void add_inputs(CLI::App& app, Detect_command& command) {
  app.add_option(
         "INPUT", command.inputs,
         "A scene (.json), or two or more meshes or animations (.off .obj .ply .stl .gltf .glb .md2 .md3, a "
         "pattern such as 'cloth_*.obj', MESH+CACHE with .pc2 or .mdd, SCENE.json#OBJECT, shape:teapot); one with "
         "--self, --components or --parts; - is the standard input")
      ->required()
      ->type_name("FILE")
      ->check(not_empty());
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
  app.add_option(
         "--particles", options.particles,
         "Particles per object; 0: what the scene says, else the number of objects that can touch it at once, at least "
         "12. Modes exact and certified: regions at the top of its tree; 0: what the scene says, else 12 with a "
         "strategy, a setting of it or --keep-islands, else none")
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
  app.add_flag(
      "--impacts", command.impacts,
      "Modes exact and certified: also report when object pairs meet first between a frame and the next, if every "
      "vertex moves on a straight line");
  app.add_flag("--truth", command.truth,
               "Compare every frame with exhaustive exact checking, for pairs of two objects; not for self-collisions; "
               "needs all positions, also in mode certified");
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
      ->check(number_above_0(false))
      ->capture_default_str();
  app.add_option("--collision-distance", options.collision_distance,
                 "Mode senin, or particles with --meetings 0: particles nearer than this make their regions a "
                 "candidate; in mean edge lengths, or what --distance-measure says")
      ->check(number_above_0(false))
      ->capture_default_str();
  app.add_option(
         "--distance-measure", options.distance_measure,
         "Mode senin, or particles with --meetings 0: unit of the collision distance: adjacent_vertices, the mean edge "
         "length; all_vertices, the mean distance of any two vertices, as published")
      ->transform(one_of<Distance_measure>({{"adjacent_vertices", Distance_measure::adjacent_vertices},
                                            {"all_vertices", Distance_measure::all_vertices}}))
      ->type_name("MEAN")
      ->default_str("adjacent_vertices");
  app.add_option("--candidates", options.candidates,
                 "Mode senin, or particles with --meetings 0: which of these candidates to check: all, closest")
      ->transform(one_of<Candidate_choice>({{"all", Candidate_choice::all}, {"closest", Candidate_choice::closest}}))
      ->type_name("WHICH")
      ->default_str("all");
  app.add_option(
         "--growth", options.growth,
         "Mode particles: repartition when a region exceeds this multiple of the largest initial area; inf: never")
      ->check(number_above_0(true))
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
  auto* const html = add_html(app, command.html,
                              "Page (.html) that shows the run; --contacts then defaults to all; needs all "
                              "positions, also in mode certified");
  app.add_option("--html-frames", command.html_frames,
                 "Maximum number of frames on the page: one of every few; 0: few enough to keep it small")
      ->needs(html)
      ->check(CLI::Range(std::size_t{0}, std::size_t{1'000'000}))
      ->capture_default_str();
  app.add_option("--paraview", command.paraview,
                 "Folder for meshes.pvd, particles.pvd and contacts.pvd; needs all positions, also in mode certified")
      ->type_name("DIR")
      ->check(not_empty());
  add_shard_options(app, command);
  auto* const all_rows =
      app.add_flag("--all-rows", command.all_rows, "Print all rows of the table, not only the first 20");
  auto* const json =
      app.add_flag("--json", command.json, "Print the summary as JSON in place of the table")->excludes(all_rows);
  app.add_flag("--quiet", command.quiet, "No progress bar, one line in place of the table")
      ->excludes(json)
      ->excludes(all_rows);
  app.add_flag("--exit-code", command.exit_code, "Exit with 1 if anything collides, is near or meets");
}

/// Refuses options that would be ignored.
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

/// Sets what follows from the options that are given.
void set_defaults(const CLI::App& app, Detect_command& command) {
  auto& options = command.options;
  // Shards cannot know what earlier frames have done to the trees.
  command.independent_frames |= finds_all(options.mode) && (command.shard || command.merge_shards);
  command.chooses_strategy = chooses_strategy(app);
  command.chooses_particles = options.particles > 0;
  // A user who chooses a strategy wants to see regions.
  if (finds_all(options.mode) && command.chooses_strategy && options.particles == 0)
    options.particles = options.least_particles;
  options.senin.seed = command.partition.settings.seed;
  command.partition.settings.lbg.threads = options.threads;
}

/// Pages and patches show contacts, so they ask for all of them by default.
void set_default_contacts(const CLI::App& app, Detect_command& command) {
  if ((!command.html.empty() || command.options.exact.patches) && app.count("--contacts") == 0)
    command.options.contacts = Contact_query::all;
}

}  // namespace

void add_detect(CLI::App& program, Detect_command& command, std::string& format) {
  auto& app = *program.add_subcommand("detect", "Find collisions between meshes, or through all frames of a scene");
  add_inputs(app, command);
  add_mode(app, command.options);
  add_contact_options(app, command);
  add_particle_options(app, command.options);
  add_exact_options(app, command.options.exact);
  add_threads(app, command.options.threads, "Maximum number of threads; 0: all of the machine");
  add_strategy_options(app, command.partition, "Seed, for random strategies and --mode senin");
  add_keep_islands(app, command.options.partition);
  add_outputs(app, command);
  add_reading(app, command.reading);
  add_format(app, format);
  app.footer(strategy_list() + "\n\n" + exit_code::help);
}

void complete(const CLI::App& app, Detect_command& command) {
  set_default_contacts(app, command);
  refuse_options(app, command);
  set_defaults(app, command);
}

}  // namespace lodestone
