// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "volumes/volume_scene.h"

/// The cells of the tables.
namespace lodestone {

/// A cell without a figure.
inline const std::string no_cell = "-";

/// A table with its title above and an empty line below.
inline std::string titled(std::string_view title, const std::string& table) {
  return fmt::format("{}:\n\n{}\n", title, table);
}

/// About three digits.
inline std::string ratio_cell(double ratio) {
  if (!std::isfinite(ratio) || ratio <= 0) return no_cell;
  return fmt::format("{:.{}f}", ratio, ratio < 0.1 ? 3 : ratio < 10 ? 2 : ratio < 100 ? 1 : 0);
}

/// Share of the collisions asked about that an entry saw.
inline double recall(const Volume_scene& scene, std::size_t index) {
  const auto colliding = static_cast<double>(scene.race.colliding);
  return 1 - static_cast<double>(scene.race.entries[index].missed) / colliding;
}

/// Number of these collisions, and of false ones.
inline std::string seen_cell(const Volume_scene& scene, std::size_t index) {
  const auto& f = scene.race.entries[index];
  const auto seen = fmt::format("{} of {}", scene.race.colliding - f.missed, scene.race.colliding);
  return f.invented == 0 ? seen : fmt::format("{}, {} false", seen, f.invented);
}

/// Two digits.
inline std::string seconds_cell(double seconds) {
  return fmt::format("{:.{}f}", seconds, seconds < 0.1 ? 3 : seconds < 1 ? 2 : seconds < 10 ? 1 : 0);
}

/// In the last sampled frame.
inline const Tightness& tightness(const Volume_scene& scene, std::string_view model, std::string_view strategy) {
  return scene.contestants[static_cast<std::size_t>(scene.index_of(model, strategy))].figures->last;
}

/// A kind of piece whose tightness is measured.
struct Tightness_piece {
  const char* name;
  double Tightness::*figure;
};
constexpr Tightness_piece tightness_pieces[] = {{"leaves", &Tightness::leaves},
                                                {"regions", &Tightness::regions},
                                                {"regions refitted", &Tightness::regions_refitted},
                                                {"objects", &Tightness::objects}};

}  // namespace lodestone
