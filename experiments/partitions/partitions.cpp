// SPDX-License-Identifier: GPL-3.0-or-later
// Every strategy on every mesh: how good are its partitions, and what do particles find with them?
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <span>

#include "lodestone/io/files/atomic_file.h"
#include "lodestone/io/results/coloured_ply.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/saved_state.h"
#include "partitions/manifest.h"
#include "partitions/partition_plan.h"
#include "partitions/partition_report.h"
#include "partitions/partition_run.h"
#include "partitions/row_file.h"
#include "partitions/sweep.h"
#include "program/progress.h"
#include "shared/experiment.h"
#include "shared/measured_run.h"
#include "shared/sharded_rows.h"

namespace lodestone {

namespace {

/// Coloured meshes to look at: the teapot by every strategy.
void write_pictures(const std::filesystem::path& folder) {
  constexpr std::size_t regions = 32;
  for (const auto& variant : partition_variants()) {
    Surface_mesh mesh = partition_meshes()[1].make();
    const auto map = mesh.add_property_map<Surface_mesh::Vertex_index, Region_index>("v:region").first;
    partition(mesh, regions, map, make_strategy(variant.strategy, variant.settings), variant.options);
    std::vector<Region_index> labels;
    for (const auto v : mesh.vertices()) labels.push_back(map[v]);
    write_coloured_ply(folder / (variant.name + ".ply"), mesh, labels);
  }
}

std::string said_of(const std::vector<std::string>& failures) {
  std::string text = fmt::format("{} runs failed and will be tried again:", failures.size());
  for (const auto& failure : failures) text += " " + failure + ";";
  text.back() = '.';
  return text;
}

/// Runs with other labels, or in another number, are other work.
Sharded_experiment work_of(const std::vector<std::string>& ids) {
  auto inputs = partition_manifest();
  for (const char* key : {"processors", "revision"}) inputs.erase(key);  // each shard records both
  const auto names = fmt::format("{}", fmt::join(ids, "\n"));
  inputs["runs"] = fmt::format("{:016x}", lodestone::hash_of(std::as_bytes(std::span<const char>(names))));
  return {.pieces = ids.size(), .neighbours = false, .inputs = std::move(inputs)};
}

/// In a journal, the id of the row that tells of which work it is.
constexpr const char* row_of_work = "work";

/// Whether a journal holds runs of other work than a folder, such as of another revision.
bool is_of_other_work(const Row_file& journal, const Shard_folder& folder) {
  const auto work = journal.rows().find(row_of_work);
  return work == journal.rows().end() || work->second.value("hash", "") != folder.work();
}

/// Makes the runs of one shard. Those that are finished are kept in its journal, and then in the shard, in order.
std::string make_shard(const Experiment_context& context, const std::vector<Partition_run>& plan,
                       const std::vector<std::string>& all_ids) {
  const auto work = work_of(all_ids);
  const auto folder = shard_folder(context, work);
  const std::size_t index = context.shard->index;
  const auto runs = chosen_pieces(context, work);
  if (folder.is_done(index)) return said_of_shard(folder, index, runs.size());
  std::vector<std::string> ids;
  for (const auto run : runs) ids.push_back(all_ids[run]);
  {
    Row_file rows(folder.journal(index), Row_file::Damage::drop);
    if (is_of_other_work(rows, folder)) rows.clear();
    rows.add({{"id", row_of_work}, {"hash", folder.work()}});
    const auto failures = sweep(
        ids, rows, {.jobs = context.jobs}, [&](std::size_t run) { return execute(plan[runs[run]]); }, context.progress);
    if (!failures.empty()) throw Bad_shard(said_of(failures));
    Shard_writer shard(folder, index);
    for (const auto& id : ids) shard.add(rows.rows().at(id).dump());
    shard.commit({{"processors", partition_manifest()["processors"]}});
  }
  std::filesystem::remove(folder.journal(index));
  return said_of_shard(folder, index, runs.size());
}

/// Writes the files that an unsharded sweep would have left, from the shards.
void merge(const Experiment_context& context, const std::vector<std::string>& ids) {
  const auto folder = shard_folder(context, work_of(ids));
  std::map<std::string, std::string> lines;
  auto manifest = partition_manifest();
  const auto records = folder.read_all([&](std::string_view line) {
    check_interrupt();
    lines.emplace(nlohmann::json::parse(line).at("id").get<std::string>(), line);
  });
  manifest["revision"] = folder.manifest()["revision"];
  manifest["processors"] = records.front().at("processors");
  Atomic_file rows(context.out / "rows.jsonl");
  for (const auto& id : ids) {
    const auto line = lines.find(id);
    if (line == lines.end()) throw Bad_shard(folder.results().string() + ": its shards have no run " + id);
    rows.write(line->second + "\n");
  }
  rows.commit();
  std::filesystem::remove(context.out / "manifest.json");  // of an earlier sweep, whose rows are gone
  write_manifest(context.out, manifest);
  for (const auto& record : records) {
    manifest["processors"] = record.at("processors");
    write_manifest(context.out, manifest);
  }
}

}  // namespace

std::string run_partitions(const Experiment_context& context) {
  if (!context.write_meshes.empty()) {
    write_partition_meshes(context.write_meshes);
    return fmt::format("The meshes are in {}. Nothing was measured.\n", context.write_meshes.string());
  }
  const auto plan = partition_plan(context.only, read_given_labels(context.strategy_files));
  std::vector<std::string> ids;
  for (const auto& run : plan) ids.push_back(run.id());

  if (context.shard) return make_shard(context, plan, ids);
  if (context.merge_shards) merge(context, ids);
  Row_file rows(context.out / "rows.jsonl");
  // A finished sweep is only reported: by any revision, for no rows are added.
  const auto to_do = [&](const auto& id) { return !rows.has(id); };
  if (std::ranges::any_of(ids, to_do)) write_manifest(context.out, partition_manifest());
  const auto failures = sweep(
      ids, rows, {.jobs = context.jobs}, [&](std::size_t run) { return execute(plan[run]); }, context.progress);
  if (!failures.empty()) throw Bad_shard(said_of(failures));

  std::map<std::string, nlohmann::ordered_json> chosen;
  for (const auto& id : ids) chosen.emplace(id, rows.rows().at(id));
  write_json(context.out, "figures", partition_figures(chosen));
  if (context.only.empty()) write_pictures(context.out / "pictures");
  return partition_report(chosen);
}

}  // namespace lodestone
