// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/shard_options.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "program/command_line.h"
#include "program/shards.h"

namespace lodestone {

void add_shard_options(CLI::App& app, Detect_command& command) {
  app.add_option_function<std::string>(
         "--shard", [&command](const std::string& text) { command.shard = parse_shard(text); },
         "Play only the I-th of N parts of the frames, into --out; lodestone merge joins the parts")
      ->type_name("I/N");
  app.add_flag("--independent-frames", command.independent_frames,
               "Modes exact, certified: lines of frames.jsonl do not depend on earlier frames; so with --shard");
  app.add_option("--warm-up", command.warm_up, "Modes with particles: frames that a shard plays before its own")
      ->check(CLI::Range(std::size_t{0}, std::size_t{1'000'000}))
      ->type_name("W");
  app.add_flag("--merge-shards", command.merge_shards)->group("");  // lodestone merge gives it
}

void add_submit(CLI::App& program, Submit_command& command) {
  auto& app = *program.add_subcommand("submit", "Run detect or an experiment in shards, on a cluster");
  app.footer("Example: lodestone submit --slurm --out DIR --shards 64 -- detect scene.json --contacts all");
  app.add_flag("--slurm", command.slurm, "On Slurm, by sbatch")->required();
  app.add_option("COMMAND", command.words, "After --: detect or experiment, with inputs and options")
      ->required()
      ->type_name("WORD");
  app.add_option("--out", command.out, "Folder of results, on a file system that all nodes share")
      ->required()
      ->type_name("DIR")
      ->check(not_empty());
  app.add_option("--shards", command.shards, "Number of shards; of a folder that has shards: theirs")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100'000}))
      ->type_name("N")
      ->default_str("16");
  app.add_option("--tasks", command.tasks, "Maximum number of tasks in the array; each makes several shards if needed")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100'000}))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--partition", command.partition, "Partition of the cluster")->type_name("NAME")->check(not_empty());
  app.add_option("--account", command.account, "Account to charge")->type_name("NAME")->check(not_empty());
  app.add_option("--time-factor", command.time_factor, "Time limit of a shard, in times of the longest one so far")
      ->check(finite_number(1, 1000, "1 to 1000"))
      ->capture_default_str();
  app.add_option("--memory-factor", command.memory_factor, "Memory of a shard, in memories of the largest one so far")
      ->check(finite_number(1, 1000, "1 to 1000"))
      ->capture_default_str();
  app.add_option("--minutes", command.minutes, "Time limit of a shard; with --megabytes no pilot is run")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000}))
      ->default_str("measured");
  app.add_option("--megabytes", command.megabytes, "Memory of a shard")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100'000'000}))
      ->default_str("measured");
  app.add_flag("--dry-run", command.dry_run, "Write the scripts and submit nothing");
}

void add_status(CLI::App& program, Status_command& command) {
  auto& app = *program.add_subcommand("status", "Tell which shards of a folder are done, and what to do next");
  app.add_option("DIR", command.folder, "Folder of results, the --out of the shards")
      ->required()
      ->type_name("DIR")
      ->check(not_empty());
  app.add_flag("--json", command.json, "Print JSON");
  app.add_flag("--quick", command.quick, "Look only at the end of each shard, not at all of its bytes");
}

void add_merge(CLI::App& program, Merge_command& command) {
  auto& app = *program.add_subcommand("merge", "Join the shards of a folder to the results of one run");
  app.add_option("DIR", command.folder, "Folder of results, the --out of the shards")
      ->required()
      ->type_name("DIR")
      ->check(not_empty());
  app.add_flag("--quiet", command.quiet, "No progress bar, one line or nothing in place of tables");
}

std::vector<std::string> merging_words(const Merge_command& command) {
  const Shard_folder folder(absolute(command.folder));
  auto words = folder.command();
  words.insert(words.begin(), "lodestone");
  if (words.size() < 2 || (words[1] != "detect" && words[1] != "experiment"))
    throw Bad_shard((folder.results() / "shards").string() + ": its shards are of neither detect nor an experiment");
  words.insert(words.end(), {"--out", folder.results().string(), "--merge-shards"});
  if (command.quiet) {
    for (const char* table : {"--json", "--all-rows"}) std::erase(words, table);
    words.emplace_back("--quiet");
  }
  if (const auto& begun = folder.manifest()["folder"]; begun.is_string() && is_directory(std::filesystem::path(begun)))
    std::filesystem::current_path(std::filesystem::path(begun));
  return words;
}

}  // namespace lodestone
