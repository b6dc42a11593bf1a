// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>

#include "certified_soak/random_body.h"

namespace lodestone {

/// What was checked of bodies of one kind.
struct Certified_soak_kind {
  std::string_view name;
  std::size_t rounds = 0;       ///< scenes: a body of the kind, and one or two of any
  std::size_t frames = 0;       ///< of both modes
  std::size_t colliding = 0;    ///< frames in which two bodies collide
  std::size_t partly_read = 0;  ///< frames in which the body was read in part, or not at all
  std::size_t questions = 0;    ///< beside the frames: distances, rays, points, visitors
  std::size_t differences = 0;  ///< answers to frames and questions that are others than those of mode `exact`
  std::size_t violations = 0;   ///< broken bounds that mode `certified` reports
  std::size_t boxes = 0;        ///< of nodes, compared with all vertices below; of placed bodies a second time, placed
  std::size_t outside = 0;      ///< of these: boxes with a vertex outside
  std::size_t refused = 0;      ///< leaves, or bodies as a whole, that a bound did not recognise when it was shown them
};

/// Compares mode `certified` with mode `exact` on small bodies that move at random, and bounds with positions.
///
/// The seed determines the rounds. Each plays 24 frames with its own options, and asks a further question in each.
/// Objects are placed, given positions for a frame, saved and loaded, and built anew.
///
/// @param kind      0 to `certified_soak_kinds()` - 1
/// @param frames    at least so many
/// @param progress  called with the frames played so far
Certified_soak_kind certified_soak(std::uint64_t seed, std::size_t kind, std::size_t frames,
                                   const std::function<void(std::size_t)>& progress = {});
/// The same with bodies of another kind.
Certified_soak_kind certified_soak(std::uint64_t seed, const Body_recipe& recipe, std::size_t frames,
                                   const std::function<void(std::size_t)>& progress = {});
/// How many kinds there are.
std::size_t certified_soak_kinds();
/// What a kind is called.
std::string_view certified_soak_name(std::size_t kind);

}  // namespace lodestone
