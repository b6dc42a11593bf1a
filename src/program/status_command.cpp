// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/files/small_text.h"
#include "program/commands.h"
#include "program/exit_codes.h"
#include "program/frame_log.h"
#include "program/progress.h"
#include "program/shards.h"
#include "program/slurm_scripts.h"

namespace lodestone {

namespace {

using Json = nlohmann::ordered_json;

/// What the shards of a folder are, by number.
struct Shard_census {
  std::vector<std::size_t> done, missing, broken, begun;  ///< begun ones are missing too
  std::vector<std::string> causes;                        ///< of the broken ones
  Json last;                                              ///< record of the one that was finished last; null: none
};

Shard_census census_of(const Shard_folder& folder, Shard_check check) {
  Shard_census census;
  for (std::size_t index = 1; index <= folder.shards(); ++index) {
    check_interrupt();
    const auto status = folder.status(index, check);
    if (status.state == Shard_state::broken) {
      census.broken.push_back(index);
      census.causes.push_back(status.cause);
    } else if (status.state == Shard_state::missing) {
      census.missing.push_back(index);
      if (exists(folder.journal(index))) census.begun.push_back(index);
    } else {
      census.done.push_back(index);
      if (census.last.is_null() || census.last["finished"] <= status.record["finished"]) census.last = status.record;
    }
  }
  return census;
}

/// What must stand before a command that reads the inputs, which may be relative to where the shards were begun.
std::string way_to_inputs(const Shard_folder& folder) {
  const std::string begun = folder.manifest()["folder"];
  std::error_code ignored;
  const bool is_elsewhere = begun != std::filesystem::current_path() && std::filesystem::is_directory(begun, ignored);
  return is_elsewhere ? "cd " + shell_word(begun) + " && " : "";
}

/// The folder of results, as one finds it from there.
std::string results_from_inputs(const Shard_folder& folder) {
  return shell_word((way_to_inputs(folder).empty() ? folder.results() : absolute(folder.results())).string());
}

std::string next_step(const Shard_folder& folder, const Shard_census& census) {
  if (!census.missing.empty() || !census.broken.empty())
    return fmt::format("{}lodestone submit --slurm --out {} -- {}", way_to_inputs(folder), results_from_inputs(folder),
                       shell_words(folder.command()));
  return folder.is_merged() ? "" : "lodestone merge " + shell_word(folder.results().string());
}

Json to_json(const Shard_folder& folder, const Shard_census& census) {
  Json broken = Json::array();
  for (std::size_t i = 0; i < census.broken.size(); ++i)
    broken.push_back({{"shard", census.broken[i]}, {"cause", census.causes[i]}});
  Json last;
  if (!census.last.is_null())
    for (const char* key : {"shard", "finished", "seconds", "peak_kib", "bytes"}) last[key] = census.last[key];
  return {{"folder", folder.results().string()},
          {"command", folder.command()},
          {"revision", folder.manifest()["revision"]},
          {"shards", folder.shards()},
          {"done", census.done.size()},
          {"missing", census.missing},
          {"begun", census.begun},
          {"broken", std::move(broken)},
          {"last", std::move(last)},
          {"merged", folder.is_merged()},
          {"next", next_step(folder, census)}};
}

void print(const Shard_folder& folder, const Shard_census& census) {
  fmt::print("{}: {}\n", printable(folder.results().string()), printable(shell_words(folder.command())));
  fmt::print("{} of {} done", census.done.size(), counted(folder.shards(), "shard"));
  if (!census.missing.empty()) fmt::print("; missing: {}", ranges_of(census.missing));
  if (!census.begun.empty()) fmt::print("; of these with finished runs: {}", ranges_of(census.begun));
  if (!census.broken.empty()) fmt::print("; broken: {}", ranges_of(census.broken));
  const bool is_whole = census.missing.empty() && census.broken.empty();
  fmt::print("; {}\n", !folder.is_merged() ? "not merged" : is_whole ? "merged" : "merged before these were lost");
  for (const auto& cause : census.causes) fmt::print("{}\n", printable(cause));
  if (!census.last.is_null())
    fmt::print("last: shard {}, finished {}, after {:.1f} s, {:.0f} MB of memory\n",
               census.last["shard"].get<std::size_t>(), census.last["finished"].get<std::string>(),
               census.last["seconds"].get<double>(), census.last["peak_kib"].get<double>() / 1024);
  const auto next = next_step(folder, census);
  if (!next.empty()) fmt::print("next: {}\n", printable(next));
  if (!census.missing.empty() || !census.broken.empty())
    fmt::print("or, for each of these shards I: {}lodestone {} --out {} --shard I/{}\n",
               printable(way_to_inputs(folder)), printable(shell_words(folder.command())),
               printable(results_from_inputs(folder)), folder.shards());
}

}  // namespace

int run(const Status_command& command) {
  const Shard_folder folder(command.folder);
  const auto census = census_of(folder, command.quick ? Shard_check::record : Shard_check::all);
  if (command.json)
    fmt::print("{}", json_text(to_json(folder, census), 2));
  else
    print(folder, census);
  return exit_code::success;
}

}  // namespace lodestone
