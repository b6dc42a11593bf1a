// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "volumes/volume_scene.h"

namespace lodestone {

/// The volume that others are compared with, and the strategy of the tables about volumes.
constexpr std::string_view reference_model = "aabb";
constexpr std::string_view reference_strategy = "lbg";
/// The particles that volumes are compared with.
constexpr std::string_view reference_particles = "particles, 32";

/// All tables, in Markdown: first the ratios over all scenes, then a section for each scene.
std::string volume_report(std::span<const Volume_scene> scenes);

/// The section of one scene.
std::string volume_section(const Volume_scene& scene);

/// All figures. The plots read only the lists `rows` and `tightness`.
nlohmann::ordered_json volume_json(std::span<const Volume_scene> scenes);

}  // namespace lodestone
