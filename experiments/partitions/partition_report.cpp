// SPDX-License-Identifier: GPL-3.0-or-later
#include "partitions/partition_report.h"

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "lodestone/io/results/text_table.h"
#include "partitions/partition_plan.h"
#include "shared/interval.h"
#include "shared/measured_run.h"

namespace lodestone {

namespace {

using Json = nlohmann::ordered_json;
using Rows = std::map<std::string, Json>;

/// One figure of a row, or a ratio of two.
struct Figure {
  std::string name;  ///< in the plots
  std::string key;
  std::string over = {};  ///< empty: the figure itself
  double scale = 1;
  bool is_time = false;         ///< over the meshes of a seed the median is taken, because times have outliers
  std::string trials_key = {};  ///< for a proportion: how many trials it is of; empty: no proportion

  double of(const Json& row) const {
    const auto value = scale * row.at(key).get<double>();
    return over.empty() ? value : value / row.at(over).get<double>();
  }
};

/// A column of a table.
struct Column {
  std::string title;
  Figure figure;
  int decimals = 2;
};

const std::vector<Column>& partition_columns() {
  static const std::vector<Column> columns{
      {"distortion x 1000", {"distortion", "distortion", {}, 1000}},
      {"largest / mean", {"size_balance", "size_balance"}},
      {"parts", {"parts_per_region", "parts_per_region"}},
      {"border", {"border_length", "border_length"}},
      {"normals (deg)", {"normal_deviation", "normal_deviation"}, 1},
      {"radius", {"geodesic_radius", "geodesic_radius"}, 3},
      {"boxes", {"box_volume", "box_volume"}},
      {"balls", {"ball_volume", "ball_volume"}},
      {"time / lbg", {"partition_time", "seconds", "lbg_seconds", 1, true}},
      {"peak (MiB)", {"peak_mib", "peak_kib", {}, 1.0 / 1024}, 1},
  };
  return columns;
}

const std::vector<Column>& use_columns() {
  static const std::vector<Column> columns{
      {"recall", {"recall", "recall", {}, 1, false, "positive"}, 3},
      {"delay (frames)", {"delay_frames", "delay_frames"}},
      {"iterations", {"iterations", "iterations"}, 1},
      {"candidates", {"candidates", "candidates"}, 1},
      {"exact tests", {"exact_tests", "exact_tests"}, 1},
      {"repartitions", {"repartitions", "repartitions"}},
      {"frame (us)", {"frame_us", "frame_us", {}, 1, true}, 1},
      {"frame / lbg", {"frame_time", "frame_us", "lbg_frame_us", 1, true}},
  };
  return columns;
}

/// Of the same particles with meetings.
const std::vector<Column>& meeting_columns() {
  static const std::vector<Column> columns{
      {"recall", {"met_recall", "met_recall", {}, 1, false, "positive"}, 3},
      {"positions read", {"met_vertices_read", "met_vertices_read"}, 0},
      {"frame (us)", {"met_frame_us", "met_frame_us", {}, 1, true}, 1},
      {"frame / lbg", {"met_frame_time", "met_frame_us", "met_lbg_frame_us", 1, true}},
      {"mean frame / lbg", {"met_mean_frame_time", "met_mean_frame_us", "met_lbg_mean_frame_us", 1, true}},
      {"frame / published", {"met_over_published", "met_frame_us", "frame_us", 1, true}},
  };
  return columns;
}

/// Rows of earlier revisions have no figures of meetings.
bool have_meetings(const Rows& rows) {
  return std::ranges::all_of(rows, [](const auto& row) { return row.second.contains("met_recall"); });
}

/// The rows by variant, number of regions and seed.
using By_seed = std::map<std::uint64_t, std::vector<const Json*>>;
using By_regions = std::map<std::size_t, By_seed>;
using By_variant = std::map<std::string, By_regions>;

By_variant sorted_by_variant(const Rows& rows, const std::string& mesh = {}) {
  By_variant sorted;
  for (const auto& [id, row] : rows)
    if (mesh.empty() || row.at("mesh") == mesh)
      sorted[row.at("variant")][row.at("regions_wanted")][row.at("seed")].push_back(&row);
  return sorted;
}

/// Mean or median over the rows of each seed, then the interval over the seeds.
Interval summary(const By_seed& seeds, const Figure& figure) {
  std::vector<double> of_seeds;
  double trials = 0;
  for (const auto& [seed, rows] : seeds) {
    std::vector<double> values;
    for (const Json* row : rows) {
      values.push_back(figure.of(*row));
      if (!figure.trials_key.empty()) trials += row->at(figure.trials_key).get<double>();
    }
    of_seeds.push_back(figure.is_time ? median(values) : mean(values));
  }
  return figure.trials_key.empty() ? mean_interval(of_seeds) : proportion_interval(of_seeds, trials);
}

/// The mean, with half the width of its interval unless that rounds to zero.
std::string text_of_mean(const Interval& interval, int decimals) {
  const std::string mean = fmt::format("{:.{}f}", interval.mean, decimals);
  const std::string half = fmt::format("{:.{}f}", interval.high - interval.mean, decimals);
  const bool nothing = half.find_first_of("123456789") == std::string::npos;
  return nothing ? mean : mean + " +- " + half;
}

/// The mean, with the ends of its interval unless they are printed alike: of proportions, they lie on both sides of the
/// mean at different distances.
std::string text_of_proportion(const Interval& interval, int decimals) {
  const auto text = [&](double value) { return fmt::format("{:.{}f}", value, decimals); };
  if (text(interval.low) == text(interval.high)) return text(interval.mean);
  return fmt::format("{} ({}..{})", text(interval.mean), text(interval.low), text(interval.high));
}

std::string text_of(const Interval& interval, const Column& column) {
  return (column.figure.trials_key.empty() ? text_of_mean : text_of_proportion)(interval, column.decimals);
}

/// In the order of the registry, then those whose labels are given.
std::vector<std::string> variants_of(const By_variant& sorted) {
  std::vector<std::string> names;
  for (const auto& variant : partition_variants())
    if (sorted.contains(variant.name)) names.push_back(variant.name);
  for (const auto& [name, rows] : sorted)
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  return names;
}

bool is_weight(const std::string& variant) { return variant.starts_with("lbg, normals"); }

/// Number of regions that most tables are about.
constexpr std::size_t shown_regions = 32;
/// The mesh name of figures over all meshes.
constexpr const char* all_meshes = "all";

std::string columns_table(const By_variant& sorted, const std::vector<std::string>& variants,
                          const std::vector<Column>& columns) {
  std::vector<std::string> header{"strategy", "meshes"};
  for (const auto& column : columns) header.push_back(column.title);
  Text_table table(header);
  for (const auto& variant : variants) {
    const auto seeds = sorted.at(variant).find(shown_regions);
    if (seeds == sorted.at(variant).end()) continue;
    std::vector<std::string> row{variant, std::to_string(seeds->second.begin()->second.size())};
    for (const auto& column : columns) row.push_back(text_of(summary(seeds->second, column.figure), column));
    table.add(std::move(row));
  }
  return table.text();
}

/// A table of one figure against the number of regions.
/// @param text_for  gives the text for a number of regions and the rows of a variant by seed
template <class Text_for>
std::string regions_table(const By_variant& sorted, const std::vector<std::string>& variants, Text_for text_for) {
  std::vector<std::string> header{"strategy"};
  for (const auto regions : partition_counts) header.push_back(fmt::format("{} regions", regions));
  Text_table table(header);
  for (const auto& variant : variants) {
    std::vector<std::string> row{variant};
    for (const auto regions : partition_counts) {
      const auto seeds = sorted.at(variant).find(regions);
      row.push_back(seeds == sorted.at(variant).end() ? "-" : text_for(regions, seeds->second));
    }
    table.add(std::move(row));
  }
  return table.text();
}

std::string regions_table(const By_variant& sorted, const std::vector<std::string>& variants, const Column& column) {
  return regions_table(sorted, variants, [&](std::size_t, const By_seed& seeds) {
    return text_of(summary(seeds, column.figure), column);
  });
}

/// Recall by mesh, number of regions and seed: of one scene.
using Recall_by_scene = std::map<std::tuple<std::string, std::size_t, std::uint64_t>, double>;

Recall_by_scene recall_by_scene(const By_regions& by_regions) {
  Recall_by_scene recall;
  for (const auto& [regions, seeds] : by_regions)
    for (const auto& [seed, rows] : seeds)
      for (const Json* row : rows) recall[{row->at("mesh"), regions, seed}] = row->at("recall");
  return recall;
}

/// Recall minus that of `lbg` in the same scenes, with the interval of the difference; empty if `lbg` did not take
/// part.
std::string recall_difference_table(const By_variant& sorted, const std::vector<std::string>& variants) {
  if (!sorted.contains("lbg")) return {};
  const auto of_lbg = recall_by_scene(sorted.at("lbg"));
  return regions_table(sorted, variants, [&](std::size_t regions, const By_seed& seeds) {
    std::vector<double> of_seeds;
    for (const auto& [seed, rows] : seeds) {
      std::vector<double> differences;
      for (const Json* row : rows)
        if (const auto lbg = of_lbg.find({row->at("mesh"), regions, seed}); lbg != of_lbg.end())
          differences.push_back(row->at("recall").get<double>() - lbg->second);
      if (!differences.empty()) of_seeds.push_back(mean(differences));
    }
    return of_seeds.empty() ? "-" : text_of_proportion(difference_interval(of_seeds), 3);
  });
}

std::vector<std::string> present(const By_variant& sorted, const std::vector<std::string>& wanted) {
  std::vector<std::string> names;
  std::ranges::copy_if(wanted, std::back_inserter(names), [&](const auto& name) { return sorted.contains(name); });
  return names;
}

/// To six digits, for plots.
double rounded(double value) { return std::stod(fmt::format("{:.6g}", value)); }

void add_figures(const By_variant& sorted, const std::string& mesh, Json& figures) {
  for (const auto& [variant, by_regions] : sorted)
    for (const auto& [regions, seeds] : by_regions) {
      if (mesh != all_meshes && regions != shown_regions) continue;
      for (const auto* columns : {&partition_columns(), &use_columns()})
        for (const auto& column : *columns) {
          const Interval interval = summary(seeds, column.figure);
          const Json& row = *seeds.begin()->second.front();
          figures.push_back({{"variant", variant},
                             {"strategy", row.at("strategy")},
                             {"normal_weight", row.at("normal_weight")},
                             {"islands_kept", row.at("islands_kept")},
                             {"regions", regions},
                             {"mesh", mesh},
                             {"figure", column.figure.name},
                             {"mean", rounded(interval.mean)},
                             {"low", rounded(interval.low)},
                             {"high", rounded(interval.high)}});
        }
    }
}

}  // namespace

std::string partition_report(const Rows& rows) {
  const auto sorted = sorted_by_variant(rows);
  std::vector<std::string> strategies, weights{"lbg_position"};
  for (const auto& name : variants_of(sorted)) (is_weight(name) ? weights : strategies).push_back(name);
  weights.emplace_back("lbg");
  weights = present(sorted, weights);
  const auto islands = present(sorted, {"lbg", "lbg, islands kept"});

  std::string text = fmt::format("{} runs.\n\n## Partitions of {} regions\n\n", rows.size(), shown_regions);
  text += columns_table(sorted, strategies, partition_columns());
  text += fmt::format("\n## In use, {} particles per object\n\n", shown_regions);
  text += columns_table(sorted, strategies, use_columns());
  if (have_meetings(rows)) {
    text += fmt::format("\n## In use with meetings, {} particles per object\n\n", shown_regions);
    text += columns_table(sorted, strategies, meeting_columns());
    text += "\nRecall with meetings:\n\n" + regions_table(sorted, strategies, meeting_columns()[0]);
    text += "\nFrame with meetings over that of `lbg`:\n\n" + regions_table(sorted, strategies, meeting_columns()[3]);
  }
  text += "\n## Recall\n\n" + regions_table(sorted, strategies, use_columns()[0]);
  text += "\nDifference from the recall of `lbg` in the same scenes:\n\n" + recall_difference_table(sorted, strategies);
  text += "\n## Repartitions\n\n" + regions_table(sorted, strategies, use_columns()[5]);
  text += "\n## Weight of the normals\n\n" + columns_table(sorted, weights, partition_columns());
  text += "\nRecall:\n\n" + regions_table(sorted, weights, use_columns()[0]);
  if (have_meetings(rows)) text += "\nWith meetings:\n\n" + columns_table(sorted, weights, meeting_columns());
  text += "\n## Island repair\n\n" + columns_table(sorted, islands, partition_columns());
  text += "\n" + columns_table(sorted, islands, use_columns());
  return text;
}

Json partition_figures(const Rows& rows) {
  Json figures = Json::array();
  add_figures(sorted_by_variant(rows), all_meshes, figures);
  for (const auto& mesh : partition_meshes())
    add_figures(sorted_by_variant(rows, std::string(mesh.name)), std::string(mesh.name), figures);
  return figures;
}

}  // namespace lodestone
