// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/sharded_rows.h"

#include <fmt/format.h>

#include <utility>

#include "program/progress.h"

namespace lodestone {

namespace {

using Row = nlohmann::ordered_json;

/// Rows of all shards in the order of the pieces.
std::vector<Row> merged_rows(const Experiment_context& context, const Sharded_experiment& work) {
  const auto folder = shard_folder(context, work);
  std::vector<Row> rows(work.pieces);
  std::vector<std::size_t> order;
  for (std::size_t index = 1; index <= folder.shards(); ++index) {
    const auto shard = folder.shard(index);
    const auto pieces = work.neighbours ? shard.neighbours(work.pieces) : shard.scattered(work.pieces);
    order.insert(order.end(), pieces.begin(), pieces.end());
  }
  std::size_t line_number = 0;
  folder.read_all([&](std::string_view line) {
    check_interrupt();
    if (line_number == order.size()) throw Bad_shard(folder.results().string() + ": its shards have too many rows");
    rows[order[line_number++]] = parse_shard_line(line);
  });
  if (line_number < order.size()) throw Bad_shard(folder.results().string() + ": its shards have too few rows");
  return rows;
}

}  // namespace

std::vector<std::size_t> chosen_pieces(const Experiment_context& context, const Sharded_experiment& work) {
  const Shard shard = context.shard.value_or(Shard());
  return work.neighbours ? shard.neighbours(work.pieces) : shard.scattered(work.pieces);
}

Shard_folder shard_folder(const Experiment_context& context, const Sharded_experiment& work) {
  Work made{.command = context.words, .shards = 1, .pieces = work.pieces, .inputs = work.inputs};
  if (context.shard) {
    made.shards = context.shard->count;
    return {context.out, made, Shard_use::make};
  }
  const Shard_folder folder(context.out);
  made.command = folder.command();
  made.shards = folder.shards();
  return {context.out, made, Shard_use::merge};
}

std::string said_of_shard(const Shard_folder& folder, std::size_t index, std::size_t made) {
  return fmt::format("shard {} of {}: {} of {} pieces, in {}\n", index, folder.shards(), made,
                     folder.manifest()["pieces"].get<std::size_t>(), folder.file(index).string());
}

Sharded_rows rows_of(
    const Experiment_context& context, const Sharded_experiment& work,
    const std::function<void(const std::vector<std::size_t>&, const std::function<void(Row)>&)>& make) {
  Sharded_rows result;
  if (context.merge_shards) {
    result.rows = merged_rows(context, work);
    return result;
  }
  const auto pieces = chosen_pieces(context, work);
  if (!context.shard) {
    make(pieces, [&](Row row) { result.rows.push_back(std::move(row)); });
    return result;
  }
  const auto folder = shard_folder(context, work);
  const std::size_t index = context.shard->index;
  if (!folder.is_done(index)) {
    Shard_writer shard(folder, index);
    make(pieces, [&](const Row& row) { shard.add(row.dump()); });
    shard.commit();
  }
  result.shard = said_of_shard(folder, index, pieces.size());
  return result;
}

}  // namespace lodestone
