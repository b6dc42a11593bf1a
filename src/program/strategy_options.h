// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>
#include <vector>

#include "lodestone/mesh/errors.h"
#include "lodestone/partition/strategies.h"

namespace lodestone {

/// Whether the user chose a strategy, or one of its settings, or how regions are repaired.
inline bool chooses_strategy(const CLI::App& command) {
  const auto names = {"--strategy", "--seed",          "--normal-weight", "--split",
                      "--epsilon",  "--lbg-tolerance", "--lbg-sample",    "--keep-islands"};
  return std::ranges::any_of(names, [&](const char* name) { return command.count(name) > 0; });
}

/// Refuses options that the strategy would ignore. All strategies accept a seed.
/// @param threads  whether --threads concerns nothing but the strategy
/// @throws Bad_argument  names the option and the strategies that take it
inline void refuse_options_of_other_strategies(const CLI::App& command, std::string_view strategy, bool threads) {
  struct Strategy_option {
    const char* name;
    Lbg_setting setting;
  };
  std::vector<Strategy_option> options{{"--normal-weight", Lbg_setting::normal_weight},
                                       {"--split", Lbg_setting::split_rule},
                                       {"--epsilon", Lbg_setting::split},
                                       {"--lbg-sample", Lbg_setting::sample},
                                       {"--lbg-tolerance", Lbg_setting::tolerance}};
  if (threads) options.push_back({"--threads", Lbg_setting::threads});
  for (const auto& option : options) {
    if (command.count(option.name) == 0 || strategy_reads(strategy, option.setting)) continue;
    throw Bad_argument(fmt::format("{} needs --strategy {}: the strategy {} ignores it", option.name,
                                   fmt::join(strategies_that_read(option.setting), " or "), strategy));
  }
}

}  // namespace lodestone
