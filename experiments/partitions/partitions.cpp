// SPDX-License-Identifier: GPL-3.0-or-later
// Every strategy on every mesh: how good are its partitions, and what do particles find with them?
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "lodestone/io/results/coloured_ply.h"
#include "lodestone/mesh/errors.h"
#include "partitions/manifest.h"
#include "partitions/partition_plan.h"
#include "partitions/partition_report.h"
#include "partitions/partition_run.h"
#include "partitions/sweep.h"
#include "shared/experiment.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

/// Takes over the rows of other folders, if one program made them and those that are there.
void merge(const Experiment_context& context, Row_file& rows) {
  for (const auto& folder : context.merge) {
    write_manifest(context.out, read_manifest(folder));
    for (const auto& [id, row] : read_rows(folder / "rows.jsonl")) rows.add(row);
  }
}

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

}  // namespace

std::string run_partitions(const Experiment_context& context) {
  if (!context.write_meshes.empty()) {
    write_partition_meshes(context.write_meshes);
    return fmt::format("The meshes are in {}. Nothing was measured.\n", context.write_meshes.string());
  }
  const auto plan = partition_plan(context.only, read_given_labels(context.strategy_files));
  std::vector<std::string> ids;
  for (const auto& run : plan) ids.push_back(run.id());

  Row_file rows(context.out / "rows.jsonl");
  merge(context, rows);
  // A finished sweep is only reported: by any revision, for no rows are added.
  const auto to_do = [&](const auto& id) { return !rows.has(id); };
  if (std::ranges::any_of(ids, to_do)) write_manifest(context.out, partition_manifest());
  const auto failures = sweep(
      ids, rows, {.jobs = context.jobs, .shard = {.k = context.shard, .n = context.shards}},
      [&](std::size_t run) { return execute(plan[run]); }, context.progress);
  if (!failures.empty()) throw Bad_argument(said_of(failures));

  const auto missing = std::ranges::count_if(ids, to_do);
  std::map<std::string, nlohmann::ordered_json> chosen;
  for (const auto& id : ids)
    if (rows.has(id)) chosen.emplace(id, rows.rows().at(id));
  write_json(context.out, "figures", partition_figures(chosen));
  if (context.only.empty() && missing == 0) write_pictures(context.out / "pictures");
  return (missing > 0 ? fmt::format("{} of {} runs are still to do: run the other shards, and --merge them.\n\n",
                                    missing, ids.size())
                      : "") +
         partition_report(chosen);
}

}  // namespace lodestone
