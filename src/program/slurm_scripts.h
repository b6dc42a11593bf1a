// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lodestone {

/// What the scripts for sbatch say.
struct Slurm_job {
  std::string program;                                ///< path of `lodestone`, the same on all nodes
  std::filesystem::path folder;                       ///< in which the command runs
  std::filesystem::path out;                          ///< absolute
  std::vector<std::string> words;                     ///< the command, without --out and --shard
  std::size_t shards = 1, tasks = 1;                  ///< task t makes shards t, t + tasks, ...
  std::vector<std::size_t> to_do;                     ///< tasks to submit, counted from 1
  std::size_t minutes = 1, megabytes = 1, cores = 1;  ///< of a task
  std::size_t merge_minutes = 1, merge_megabytes = 1;
  std::string partition, account;  ///< empty: not said
};

/// A word that a shell reads as it is.
std::string shell_word(const std::string& word);
std::string shell_words(const std::vector<std::string>& words);

/// The option that keeps a command from printing, with a blank before it; empty where it prints JSON, which excludes
/// it.
std::string_view quietly(const std::vector<std::string>& words);

/// The script of all shards: a job array.
/// @throws Bad_argument  a folder whose name sbatch cannot be told
std::string array_script(const Slurm_job& job);
/// The script that merges them.
std::string merge_script(const Slurm_job& job);

}  // namespace lodestone
