// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>
#include <vector>

#include "lodestone/mesh/errors.h"
#include "lodestone/partition/kmeans_plus_plus.h"
#include "lodestone/partition/lbg_curvature.h"
#include "lodestone/partition/lbg_position.h"

namespace lodestone {

/// Whether the user chose a strategy or one of its settings.
inline bool chooses_strategy(const CLI::App& command) {
  const auto names = {"--strategy", "--seed",          "--normal-weight", "--split",
                      "--epsilon",  "--lbg-tolerance", "--lbg-sample"};
  return std::ranges::any_of(names, [&](const char* name) { return command.count(name) > 0; });
}

/// Refuses options that the strategy would ignore. All strategies accept a seed.
/// @param threads  whether --threads concerns nothing but the strategy
/// @throws Bad_argument  names the option and the strategies that take it
inline void refuse_options_of_other_strategies(const CLI::App& command, std::string_view strategy, bool threads) {
  struct Strategy_option {
    const char* name;
    std::vector<std::string_view> strategies;
  };
  const std::vector<std::string_view> lbg{Lbg::name, Lbg_position::name, Lbg_curvature::name};
  std::vector<Strategy_option> options{
      {"--normal-weight", {Lbg::name, Lbg_curvature::name, Kmeans_plus_plus::name}},
      {"--split", lbg},
      {"--epsilon", lbg},
      {"--lbg-sample", lbg},
      {"--lbg-tolerance", {Lbg::name, Lbg_position::name, Lbg_curvature::name, Kmeans_plus_plus::name}},
  };
  if (threads) options.push_back({"--threads", lbg});
  for (const auto& option : options) {
    if (command.count(option.name) == 0 || std::ranges::find(option.strategies, strategy) != option.strategies.end())
      continue;
    throw Bad_argument(fmt::format("{} needs --strategy {}: the strategy {} ignores it", option.name,
                                   fmt::join(option.strategies, " or "), strategy));
  }
}

}  // namespace lodestone
