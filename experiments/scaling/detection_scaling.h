// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "lodestone/io/scenes/scene_file.h"

/// How the frames of mode `particles` grow, with meetings and without (the published method), in the same run.
namespace lodestone {

inline constexpr std::size_t scaling_particle_counts[] = {8, 16, 32, 64, 128};

/// Against the number of particles N: the stages of the published method, then the frames of both.
/// @param json  receives the figures as `detection`
/// @param step  called after the frames, and after each N
std::string detection_against_particles(Scene scene, const std::function<void()>& step, nlohmann::ordered_json& json);

/// Against the number of triangles, with the mode `exact` beside them.
/// @param scenes  the same motion at two or more resolutions
/// @param json    receives the figures as `triangles`
/// @param step    called after each scene
std::string detection_against_triangles(std::span<Scene> scenes, const std::function<void()>& step,
                                        nlohmann::ordered_json& json);

}  // namespace lodestone
