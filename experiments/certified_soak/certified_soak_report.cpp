// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include <string>
#include <vector>

#include "certified_soak/certified_soak.h"
#include "lodestone/io/results/text_table.h"
#include "shared/experiment.h"
#include "shared/measured_run.h"
#include "shared/sharded_rows.h"

namespace lodestone {

namespace {

constexpr std::size_t frames_per_kind = 12'000;  // of each seed

/// A number of a row, its heading and its name in JSON.
struct Column {
  const char* key;
  const char* heading;
  std::size_t Certified_soak_kind::*number;
};

constexpr Column columns[] = {
    {"rounds", "rounds", &Certified_soak_kind::rounds},
    {"frames", "frames", &Certified_soak_kind::frames},
    {"colliding", "colliding", &Certified_soak_kind::colliding},
    {"partly_read", "read in part", &Certified_soak_kind::partly_read},
    {"questions", "questions", &Certified_soak_kind::questions},
    {"differences", "differences", &Certified_soak_kind::differences},
    {"violations", "violations", &Certified_soak_kind::violations},
    {"boxes", "boxes", &Certified_soak_kind::boxes},
    {"outside", "with vertices outside", &Certified_soak_kind::outside},
    {"refused", "refused", &Certified_soak_kind::refused},
};

nlohmann::ordered_json to_json(const Certified_soak_kind& kind) {
  nlohmann::ordered_json row{{"kind", kind.name}};
  for (const auto& [key, heading, number] : columns) row[key] = kind.*number;
  return row;
}

void add(Certified_soak_kind& sum, const nlohmann::ordered_json& row) {
  for (const auto& [key, heading, number] : columns) sum.*number += row.at(key).get<std::size_t>();
}

Text_table table_of(const nlohmann::ordered_json& rows) {
  std::vector<std::string> headings{"kind"};
  for (const auto& [key, heading, number] : columns) headings.emplace_back(heading);
  Text_table table(headings);
  for (const auto& row : rows) {
    std::vector<std::string> cells{row.at("kind").get<std::string>()};
    for (const auto& [key, heading, number] : columns) cells.push_back(std::to_string(row.at(key).get<std::size_t>()));
    table.add(cells);
  }
  return table;
}

}  // namespace

std::string run_certified_soak(const Experiment_context& context) {
  const std::size_t kinds = certified_soak_kinds();
  const Sharded_experiment work{
      .pieces = kinds * context.seeds, .neighbours = false, .inputs = {{"frames", frames_per_kind}, {"kinds", kinds}}};
  const auto made = rows_of(context, work, [&](const auto& pieces, const auto& add_row_of) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const std::uint64_t seed = pieces[i] / kinds + 1;
      auto row = to_json(certified_soak(seed, pieces[i] % kinds, frames_per_kind, [&](std::size_t done) {
        if (context.progress) context.progress(i * frames_per_kind + done, pieces.size() * frames_per_kind);
      }));
      row["seed"] = seed;
      add_row_of(std::move(row));
    }
  });
  if (made.shard) return *made.shard;

  std::vector<Certified_soak_kind> sums(kinds);
  Certified_soak_kind all{.name = "all"};
  for (std::size_t piece = 0; piece < work.pieces; ++piece) {
    add(sums[piece % kinds], made.rows.at(piece));
    add(all, made.rows.at(piece));
  }
  nlohmann::ordered_json json;
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    sums[kind].name = certified_soak_name(kind);
    json.push_back(to_json(sums[kind]));
  }
  write_json(context.out, "certified_soak", json);
  json.push_back(to_json(all));
  return fmt::format(
             "Random bodies of 20 to 20480 triangles, most of which tell where they can be, are kept where they just "
             "touch. Both modes play the same frames, with random options, and answer a further question in each. The "
             "boxes of all nodes are compared with all vertices below. {}.\n\n",
             context.seeds == 1 ? "Seed 1" : fmt::format("Seeds 1 to {}", context.seeds)) +
         table_of(json).text();
}

}  // namespace lodestone
