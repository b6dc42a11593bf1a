// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "program/shards.h"
#include "shared/experiment.h"

namespace lodestone {

/// An experiment as pieces, each of which gives one row, whichever process makes it.
struct Sharded_experiment {
  std::size_t pieces = 0;
  bool neighbours = false;        ///< the pieces of a shard follow each other; else they are scattered
  nlohmann::ordered_json inputs;  ///< see Work
};

/// The pieces of the shard that the caller asked for, or all.
std::vector<std::size_t> chosen_pieces(const Experiment_context& context, const Sharded_experiment& work);

/// The folder of the shard that the caller asked for, or of those to merge.
/// @throws Bad_argument  its shards are of other work
Shard_folder shard_folder(const Experiment_context& context, const Sharded_experiment& work);

/// One line about a shard that is done.
std::string said_of_shard(const Shard_folder& folder, std::size_t index, std::size_t made);

/// What an experiment has to report about.
struct Sharded_rows {
  std::vector<nlohmann::ordered_json> rows;  ///< of all pieces, in order
  std::optional<std::string> shard;          ///< only a shard was made: one line about it, and no rows
};

/// Makes the rows of all pieces, or those of one shard into its folder; or takes all rows from shards.
///
/// @param make  makes the rows of these pieces, in order, and gives each to `add`
Sharded_rows rows_of(const Experiment_context& context, const Sharded_experiment& work,
                     const std::function<void(const std::vector<std::size_t>& pieces,
                                              const std::function<void(nlohmann::ordered_json row)>& add)>& make);

}  // namespace lodestone
