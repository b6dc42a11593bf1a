// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/queries/impact_search.h"
#include "program/scene_detector.h"

namespace lodestone {

/// When one object pair meets first between two frames.
struct Pair_impact {
  Object_id a = 0;
  Object_id b = 0;
  Impact found = {};
};

/// The impacts of object pairs while every vertex moves on a straight line from where it is in a frame, at t = 0, to
/// where it is in the next, at t = 1.
/// @param scene     posed in the frame, and so again afterwards
/// @param next      the next frame
/// @param detector  of the scene, in mode `exact`
/// @param may_meet  which pairs a <= b count; a = b: faces of one object that share no vertex
/// @return pairs that meet, in the order of their objects
std::vector<Pair_impact> impacts_until(Scene& scene, std::size_t next, Scene_detector& detector,
                                       const std::function<bool(Object_pair)>& may_meet);

}  // namespace lodestone
