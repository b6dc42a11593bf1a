// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "certified/character_race.h"
#include "certified/promise_race.h"

/// Tables and JSON of the experiment `certified`.
namespace lodestone {

std::string section(const Character_figures& figures);
/// Ratios over all scenes of a size, and how they grow; empty for no scene.
std::string summary(std::span<const Character_figures> figures);
std::string table(std::span<const Promise_figures> figures);

nlohmann::ordered_json to_json(const Character_figures& figures);
nlohmann::ordered_json to_json(const Promise_figures& figures);

}  // namespace lodestone
