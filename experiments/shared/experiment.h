// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "program/shards.h"

namespace lodestone {

struct Experiment_context {
  std::filesystem::path scenes;                                    ///< folder of the scene files
  bool scenes_given = false;                                       ///< it is not the project's own folder
  std::filesystem::path out;                                       ///< folder that receives all figures as JSON
  std::function<void(std::size_t done, std::size_t of)> progress;  ///< called often; may throw to stop
  /// Names of the scenes to play, or of meshes and strategies, or numbers of bodies or triangles, as each experiment
  /// that reads it says; empty: those of the published figures. The other experiments always play all their scenes.
  std::vector<std::string> only = {};

  // For long experiments (`partitions`, `soak`, `certified_soak`, `every_frame`).
  std::optional<Shard> shard = {};      ///< make only this part
  bool merge_shards = false;            ///< take all rows from the shards in `out`
  std::vector<std::string> words = {};  ///< of the command line, see words_of_work

  std::size_t jobs = 1;   ///< runs at a time (`partitions`)
  std::size_t seeds = 1;  ///< seeds 1 to this (`soak`, `certified_soak`)

  // For `partitions` alone.
  std::vector<std::filesystem::path> strategy_files = {};  ///< labels made by other tools: see read_given_labels

  // For `partitions` and `certified`.
  std::filesystem::path write_meshes = {};  ///< only write the meshes into this folder; empty: measure
};

/// One question, and the run that answers it.
struct Experiment {
  std::string_view name;
  std::string_view question;
  /// Measures, writes `<name>.json` into `out`, and returns a report in Markdown.
  std::string (*run)(const Experiment_context&);
  /// Which of the options that not every experiment reads it does read, such as `--scenes`. Others are refused.
  std::vector<std::string_view> options = {};
};

}  // namespace lodestone
