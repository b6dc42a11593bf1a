// SPDX-License-Identifier: GPL-3.0-or-later
#include "nested_codebook/codebook_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "lodestone/io/results/text_table.h"

namespace lodestone {

namespace {

/// The row of the same scene, regions, leaf size and reach that is split at medians.
const Codebook_row& median_row(std::span<const Codebook_row> rows, const Codebook_row& row) {
  return *std::ranges::find_if(rows, [&](const Codebook_row& other) {
    return other.scene == row.scene && other.kind.compares_with(row.kind) && other.reach == row.reach &&
           other.kind.is_base();
  });
}

/// The rows with the regions and the reach of the first.
std::string table_of_scenes(std::span<const Codebook_row> rows) {
  Text_table table({"scene", "leaf faces", "hierarchy", "faces per leaf", "build (ms)", "opened", "anchors", "leaves",
                    "leaf pairs", "vertices", "to the first", "recall", "face pairs"});
  for (const auto& row : rows) {
    if (row.reach != rows.front().reach || row.kind.regions != rows.front().kind.regions) continue;
    const auto mean = [&](std::size_t count) { return fmt::format("{:.1f}", row.per_frame(count)); };
    table.add({row.scene, std::to_string(row.kind.leaf_faces), row.kind.name,
               fmt::format("{:.1f}", Codebook_row::ratio(row.faces, row.leaves)),
               fmt::format("{:.1f}", 1e3 * row.build_seconds), mean(row.counts.opened), mean(row.counts.anchors),
               mean(row.counts.leaves), mean(row.counts.leaf_pairs), mean(row.counts.vertices),
               fmt::format("{:.1f}", row.to_first()), fmt::format("{:.3f}", row.recall()),
               fmt::format("{:.4f}", row.face_pair_recall())});
  }
  return table.text();
}

/// A figure of a row, and how a table names it.
struct Compared_figure {
  const char* title;
  double (*of)(const Codebook_row& row);
};

constexpr Compared_figure compared_figures[] = {
    {"faces per leaf", [](const Codebook_row& row) { return Codebook_row::ratio(row.faces, row.leaves); }},
    {"build", [](const Codebook_row& row) { return row.build_seconds; }},
    {"opened", [](const Codebook_row& row) { return row.per_frame(row.counts.opened); }},
    {"leaf pairs", [](const Codebook_row& row) { return row.per_frame(row.counts.leaf_pairs); }},
    {"vertices", [](const Codebook_row& row) { return row.per_frame(row.counts.vertices); }},
    {"to the first", [](const Codebook_row& row) { return row.to_first(); }},
};

/// Means over the scenes: of the recalls, and of the other figures divided by those of medians.
std::string table_over_scenes(std::span<const Codebook_row> rows) {
  std::vector<std::string> header{"regions", "leaf faces", "reach", "hierarchy"};
  for (const auto& figure : compared_figures) header.emplace_back(figure.title);
  header.insert(header.end(), {"recall", "face pairs"});
  Text_table table(header);
  for (const auto& first : rows) {
    if (first.scene != rows.front().scene) continue;
    std::vector<const Codebook_row*> alike;
    for (const auto& row : rows)
      if (row.kind.name == first.kind.name && row.kind.compares_with(first.kind) && row.reach == first.reach)
        alike.push_back(&row);
    const auto mean = [&](auto figure, int decimals) {
      double sum = 0;
      for (const Codebook_row* row : alike) sum += figure(*row);
      return fmt::format("{:.{}f}", sum / static_cast<double>(alike.size()), decimals);
    };
    std::vector<std::string> cells{std::to_string(first.kind.regions), std::to_string(first.kind.leaf_faces),
                                   fmt::format("{}", first.reach), first.kind.name};
    for (const auto& figure : compared_figures)
      cells.push_back(mean(
          [&](const Codebook_row& row) {
            const double of_median = figure.of(median_row(rows, row));
            return of_median > 0 ? figure.of(row) / of_median : 1;
          },
          2));
    cells.push_back(mean([](const Codebook_row& row) { return row.recall(); }, 3));
    cells.push_back(mean([](const Codebook_row& row) { return row.face_pair_recall(); }, 4));
    table.add(std::move(cells));
  }
  return table.text();
}

}  // namespace

nlohmann::ordered_json to_json(const Codebook_row& row) {
  return {{"scene", row.scene},
          {"frames", row.frames},
          {"regions", row.kind.regions},
          {"hierarchy", row.kind.name},
          {"leaf_faces", row.kind.leaf_faces},
          {"reach", row.reach},
          {"faces", row.faces},
          {"leaves", row.leaves},
          {"build_seconds", row.build_seconds},
          {"opened", row.counts.opened},
          {"anchors", row.counts.anchors},
          {"leaves_read", row.counts.leaves},
          {"leaf_pairs", row.counts.leaf_pairs},
          {"vertices", row.counts.vertices},
          {"read_to_first", row.counts.read_to_first},
          {"colliding", row.counts.colliding},
          {"reached", row.counts.reached},
          {"face_pairs", row.counts.contacts},
          {"face_pairs_reached", row.counts.contacts_reached}};
}

std::string codebook_report(std::span<const Codebook_row> rows) {
  return "Means over the scenes; all but the recalls in multiples of the hierarchy that is split at medians:\n\n" +
         table_over_scenes(rows) +
         fmt::format("\nPer scene and frame, below {} regions, with a reach of {}:\n\n", rows.front().kind.regions,
                     rows.front().reach) +
         table_of_scenes(rows);
}

}  // namespace lodestone
