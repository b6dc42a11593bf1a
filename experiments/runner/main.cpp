// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "lodestone/mesh/errors.h"
#include "program/command_description.h"
#include "program/command_line.h"
#include "program/exit_codes.h"
#include "program/run_reported.h"
#include "runner/experiment_command.h"
#include "runner/experiments.h"

namespace lodestone {

namespace {

/// What `--only` names depends on the experiment.
constexpr const char* only_help =
    "Scenes to play in place of all, by name (every_frame, modes, defaults, nested_codebook, volumes, peers); scenes, "
    "characters and numbers of triangles (certified); scenes and numbers of triangles (first_answer); numbers of "
    "triangles (threads); numbers of bodies (many_bodies); meshes and strategies (partitions)";

bool reads(const Experiment& experiment, std::string_view option) {
  return std::ranges::find(experiment.options, option) != experiment.options.end();
}

/// The experiments that read an option, as a list for a reader.
std::string readers_of(std::string_view option) {
  std::vector<std::string_view> names;
  for (const auto& experiment : experiments())
    if (reads(experiment, option)) names.push_back(experiment.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Names are divided at commas; one after which a blank follows is part of a name, such as `lbg, islands kept`.
std::vector<std::string> whole_names(const std::vector<std::string>& parts) {
  std::vector<std::string> names;
  for (const auto& part : parts)
    if (!names.empty() && part.starts_with(' '))
      names.back() += "," + part;
    else
      names.push_back(part);
  return names;
}

void add_options(CLI::App& app, Experiment_command& command) {
  std::vector<std::string> names;
  std::string list = "Experiments:";
  for (const auto& experiment : experiments()) {
    names.emplace_back(experiment.name);
    list += fmt::format("\n  {:<20} {}", experiment.name, experiment.question);
  }
  app.add_option("NAME", command.name, "Which one")->required()->check(one_word_of(names));
  app.add_option("--scenes", command.scenes,
                 fmt::format("Folder of the scene files ({}); every_frame and modes play all scenes of another folder "
                             "than that of the program, and subfolders with meshes NAME.off, which move if they have "
                             "a point cache NAME.pc2; certified plays the glTF files of another folder too",
                             readers_of("--scenes")))
      ->type_name("DIR")
      ->default_str("those of the program")
      ->check(not_empty());
  app.add_option("--only", command.only, only_help)->delimiter(',')->type_name("NAME");
  app.add_option("--jobs", command.jobs, fmt::format("Runs at a time ({}); their times suffer", readers_of("--jobs")))
      ->check(CLI::Range(std::size_t{1}, std::size_t{1024}))
      ->capture_default_str();
  app.add_option_function<std::string>(
         "--shard", [&command](const std::string& text) { command.shard = parse_shard(text); },
         fmt::format("Only the I-th of N parts, into --out; lodestone merge joins the parts ({})",
                     readers_of("--shard")))
      ->type_name("I/N");
  app.add_flag("--merge-shards", command.merge_shards)->group("");  // lodestone merge gives it
  app.add_option("--seeds", command.seeds,
                 fmt::format("Seeds 1 to N, each with its own meshes ({})", readers_of("--seeds")))
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000}))
      ->type_name("N")
      ->capture_default_str();
  app.add_option(
         "--strategy-file", command.strategy_files,
         fmt::format(
             "Labels made by another tool, such as 'labels/NAME/*.labels': they take part as strategy NAME ({})",
             readers_of("--strategy-file")))
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
  for (const char* option : {"--scenes", "--only", "--jobs", "--shard", "--strategy-file"})
    app.get_option("--write-meshes")->excludes(option);
  app.add_flag("--quiet", command.quiet, "No progress bar, no report on the terminal");
  app.footer(list + "\n\n" + exit_code::help);
}

/// @throws Bad_argument  an option that the experiment would ignore
void refuse_options_of_other_experiments(const CLI::App& app, const std::string& name) {
  const auto experiment = std::ranges::find(experiments(), name, &Experiment::name);
  for (const auto& other : experiments())
    for (const auto option : other.options)
      if (app.count(std::string(option)) > 0 && !reads(*experiment, option))
        throw Bad_argument(
            fmt::format("the experiment {} ignores {}, which is for {}", name, option, readers_of(option)));
}

int run_experiment(int argc, char** argv) {
  CLI::App app("Run one of the experiments");
  app.name("lodestone experiment");
  Experiment_command command;
  add_options(app, command);
  if (const auto done = parse(app, argc, argv)) return *done;
  refuse_options_of_other_experiments(app, command.name);
  command.only = whole_names(command.only);
  command.words = words_of_work({argv + 1, argv + argc});
  command.words.insert(command.words.begin(), "experiment");
  return run(command);
}

}  // namespace

}  // namespace lodestone

int main(int argc, char** argv) {
  return lodestone::run_reported([&] { return lodestone::run_experiment(argc, argv); });
}
