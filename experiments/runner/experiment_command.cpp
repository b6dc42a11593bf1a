// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "io/files/small_text.h"
#include "lodestone/io/files/atomic_file.h"
#include "lodestone/mesh/errors.h"
#include "program/exit_codes.h"
#include "program/installed_files.h"
#include "program/page_file.h"
#include "program/progress.h"
#include "program/shards.h"
#include "runner/experiment_command.h"
#include "runner/experiment_plots.h"
#include "runner/experiments.h"

namespace lodestone {

namespace {

Page page_of(const Experiment& experiment, const std::filesystem::path& out, const std::string& report) {
  const std::string name(experiment.name);
  Page page({.kind = Page_kind::experiment, .title = name + ": " + std::string(experiment.question), .report = report});
  for (auto& plot : experiment_plots(installed_files() / "experiments" / name / "plots", out))
    page.add_plot(std::move(plot));
  return page;
}

std::filesystem::path own_scenes() { return installed_files() / "scenes"; }

/// @throws Bad_scene  there is no such folder
std::filesystem::path scenes_of(const Experiment_command& command) {
  if (command.scenes.empty()) return own_scenes();
  if (std::error_code unreadable; !is_directory(command.scenes, unreadable))
    throw Bad_scene(fmt::format("{}: there is no such folder of scenes", command.scenes.string()));
  return command.scenes;
}

std::string report_of(const Experiment& experiment, const Experiment_command& command,
                      const std::filesystem::path& scenes, const std::filesystem::path& out) {
  std::error_code unreadable;
  Progress_bar bar(command.name, command.quiet);
  return experiment.run({.scenes = scenes,
                         .scenes_given = !equivalent(scenes, own_scenes(), unreadable),
                         .out = out,
                         .progress = std::ref(bar),
                         .only = command.only,
                         .shard = command.shard,
                         .merge_shards = command.merge_shards,
                         .words = command.words,
                         .jobs = command.jobs,
                         .seeds = command.seeds,
                         .strategy_files = command.strategy_files,
                         .write_meshes = command.write_meshes});
}

/// Notes that the shards have become the report, and the rows that belong to it.
void note_merged(const std::filesystem::path& out, const std::string& report_file) {
  std::vector<std::string> files{report_file};
  for (const char* file : {"rows.jsonl", "manifest.json"})
    if (exists(out / file)) files.emplace_back(file);
  Shard_folder(out).note_merged(files);
}

}  // namespace

int run(const Experiment_command& command) {
  const auto experiment = std::ranges::find_if(experiments(), [&](const auto& e) { return e.name == command.name; });
  const std::filesystem::path out = command.out.empty() ? std::filesystem::path("out") / command.name : command.out;
  const auto scenes = scenes_of(command);
  std::optional<Page_file> page;
  if (!command.html.empty()) page.emplace(command.html, out);
  const bool reports = !command.shard && command.write_meshes.empty();  // else the report of an earlier run stays
  if (reports) Shard_folder::note_replaced(out);
  const std::string report = report_of(*experiment, command, scenes, out);
  if (!reports) {
    if (!command.quiet) fmt::print("{}", report);
    return exit_code::success;
  }
  const std::string report_file = command.name + ".md";
  write_whole(out / report_file, report);
  if (command.merge_shards) note_merged(out, report_file);
  if (!command.quiet)
    fmt::print("{}\n{}\n\n{}", experiment->question, std::string(experiment->question.size(), '='), report);
  if (page) {  // after the report, which must not be lost to a plot that cannot be drawn
    page->finish(page_of(*experiment, out, report));
    page->commit();
  }
  if (!command.quiet) fmt::print("\nreport and figures: {}\n", printable(out.string()));
  if (!command.quiet && page) fmt::print("{}\n", page->summary());
  return exit_code::success;
}

}  // namespace lodestone
