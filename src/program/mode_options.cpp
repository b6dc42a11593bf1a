// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/mode_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

/// `exact`, `exact or particles`, `exact, certified or particles`.
std::string names_of(const std::vector<Mode>& modes) {
  std::vector<std::string_view> names;
  for (const auto mode : modes) names.push_back(name_of(mode));
  const auto last = names.back();
  names.pop_back();
  return names.empty() ? std::string(last) : fmt::format("{} or {}", fmt::join(names, ", "), last);
}

}  // namespace

void refuse_options_beside_meetings(const CLI::App& detect, std::size_t meetings) {
  for (const auto* option : {"--collision-distance", "--distance-measure", "--candidates"})
    if (meetings > 0 && detect.count(option) > 0)
      throw Bad_argument(
          fmt::format("{} has no effect with meetings: add --meetings 0, which is the published method", option));
  for (const auto* option : {"--opening-budget", "--opening-reach"})
    if (meetings == 0 && detect.count(option) > 0)
      throw Bad_argument(fmt::format("{} has no effect with --meetings 0", option));
}

void refuse_options_of_other_modes(const CLI::App& detect, Mode mode) {
  struct Mode_option {
    const char* name;
    std::vector<Mode> modes;
  };
  static const std::vector<Mode_option> options{
      {"--within", {Mode::exact, Mode::certified}},
      {"--closest", {Mode::exact, Mode::certified}},
      {"--impacts", {Mode::exact, Mode::certified}},
      {"--self", {Mode::exact, Mode::certified}},
      {"--self-within", {Mode::exact, Mode::certified}},
      {"--containment", {Mode::exact, Mode::certified}},
      {"--parting", {Mode::exact, Mode::certified}},
      {"--patches", {Mode::exact, Mode::certified}},
      {"--collision-distance", {Mode::particles, Mode::senin}},
      {"--distance-measure", {Mode::particles, Mode::senin}},
      {"--candidates", {Mode::particles, Mode::senin}},
      {"--growth", {Mode::particles}},
      {"--meetings", {Mode::particles}},
      {"--opening-budget", {Mode::particles}},
      {"--opening-reach", {Mode::particles}},
      {"--independent-frames", {Mode::exact, Mode::certified}},
      {"--warm-up", {Mode::particles, Mode::senin}},
      {"--open-seams", {Mode::particles, Mode::senin}},
      {"--strategy", {Mode::exact, Mode::certified, Mode::particles}},
      {"--normal-weight", {Mode::exact, Mode::certified, Mode::particles}},
      {"--split", {Mode::exact, Mode::certified, Mode::particles}},
      {"--epsilon", {Mode::exact, Mode::certified, Mode::particles}},
      {"--lbg-tolerance", {Mode::exact, Mode::certified, Mode::particles}},
      {"--lbg-sample", {Mode::exact, Mode::certified, Mode::particles}},
      {"--keep-islands", {Mode::exact, Mode::certified, Mode::particles}},
  };
  for (const auto& option : options) {
    if (detect.count(option.name) == 0 || std::ranges::find(option.modes, mode) != option.modes.end()) continue;
    throw Bad_argument(
        fmt::format("{} needs --mode {}: the mode {} ignores it", option.name, names_of(option.modes), name_of(mode)));
  }
}

}  // namespace lodestone
