// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "lodestone/mesh/errors.h"
#include "program/command_line.h"
#include "program/exit_codes.h"
#include "program/run_reported.h"
#include "runner/experiment_command.h"
#include "runner/experiments.h"

namespace lodestone {

namespace {

void add_options(CLI::App& app, Experiment_command& command) {
  std::vector<std::string> names;
  std::string list = "Experiments:";
  for (const auto& experiment : experiments()) {
    names.emplace_back(experiment.name);
    list += fmt::format("\n  {:<20} {}", experiment.name, experiment.question);
  }
  app.add_option("NAME", command.name, "Which one")->required()->check(one_word_of(names));
  app.add_option(
         "--scenes", command.scenes,
         "Folder of the scene files; modes plays all scenes of another folder than its own, and subfolders with "
         "meshes NAME.off and their point caches NAME.pc2; certified plays the glTF files of another folder too")
      ->type_name("DIR")
      ->default_str("those of the program");
  app.add_option(
         "--only", command.only,
         "Scenes to play in place of all, by name (peers, every_frame, modes, volumes, defaults, nested_codebook); "
         "numbers of bodies (many_bodies); meshes and strategies (partitions); scenes and numbers of triangles "
         "(first_answer); scenes, characters and numbers of triangles (certified)")
      ->delimiter(',')
      ->type_name("NAME");
  app.add_option("--jobs", command.jobs, "Runs at a time (partitions); their times suffer")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1024}))
      ->capture_default_str();
  app.add_option_function<std::string>(
         "--shard", [&command](const std::string& text) { command.shard = parse_shard(text); },
         "Only the I-th of N parts, into --out; lodestone merge joins the parts (partitions, soak, certified_soak, "
         "every_frame)")
      ->type_name("I/N");
  app.add_flag("--merge-shards", command.merge_shards)->group("");  // lodestone merge gives it
  app.add_option("--seeds", command.seeds, "Seeds 1 to N, each with its own meshes (soak, certified_soak)")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000}))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--strategy-file", command.strategy_files,
                 "Labels made by another tool, such as 'labels/NAME/*.labels': they take part as strategy NAME "
                 "(partitions)")
      ->type_name("PATTERN")
      ->check(not_empty());
  app.add_option("--write-meshes", command.write_meshes,
                 "Only write the meshes of the experiment into this folder: to be labelled (partitions), or as "
                 "characters in glTF (certified)")
      ->type_name("DIR")
      ->check(not_empty());
  app.add_option("--out", command.out, "Folder for the figures")
      ->type_name("DIR")
      ->default_str("out/NAME")
      ->check(not_empty());
  // With --write-meshes there is no report.
  add_html(app, command.html, "One page (.html) with the report and plots of the figures")
      ->excludes("--write-meshes")
      ->excludes("--shard");
  app.add_flag("--quiet", command.quiet, "No progress bar, no report on the terminal");
  app.footer(list + "\n\n" + exit_code::help);
}

/// Options that only some experiments read, and which these are.
struct Special_option {
  const char* name;
  std::vector<std::string> experiments;
};

const std::vector<Special_option> special_options{
    {"--only",
     {"peers", "every_frame", "modes", "many_bodies", "volumes", "defaults", "nested_codebook", "partitions",
      "first_answer", "certified", "threads"}},
    {"--jobs", {"partitions"}},
    {"--shard", {"partitions", "soak", "certified_soak", "every_frame"}},
    {"--merge-shards", {"partitions", "soak", "certified_soak", "every_frame"}},
    {"--seeds", {"soak", "certified_soak"}},
    {"--strategy-file", {"partitions"}},
    {"--write-meshes", {"partitions", "certified"}}};

/// @throws Bad_argument  an option that the experiment would ignore
void refuse_options_of_other_experiments(const CLI::App& app, const std::string& experiment) {
  for (const auto& [name, takers] : special_options)
    if (app.count(name) > 0 && std::ranges::find(takers, experiment) == takers.end())
      throw Bad_argument(
          fmt::format("the experiment {} ignores {}, which is for {}", experiment, name, fmt::join(takers, ", ")));
}

int run_experiment(int argc, char** argv) {
  CLI::App app("Run one of the experiments");
  app.name("lodestone experiment");
  Experiment_command command;
  add_options(app, command);
  if (const auto done = parse(app, argc, argv)) return *done;
  refuse_options_of_other_experiments(app, command.name);
  command.words = words_of_work({argv + 1, argv + argc});
  command.words.insert(command.words.begin(), "experiment");
  return run(command);
}

}  // namespace

}  // namespace lodestone

int main(int argc, char** argv) {
  return lodestone::run_reported([&] { return lodestone::run_experiment(argc, argv); });
}
