// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

namespace lodestone {

/// What was checked of meshes of one kind.
struct Soak_kind {
  std::string_view name;
  std::size_t rounds = 0;         ///< pairs of meshes; a tree is built on one pose and refitted to others
  std::size_t pairs = 0;          ///< face pairs whose boxes overlap, each checked by itself
  std::size_t intersecting = 0;   ///< of these
  std::size_t differences = 0;    ///< face pairs that one answer holds and the other lacks, or holds twice
  std::size_t invalid_trees = 0;  ///< trees that contradict their definition after a refit
};

struct Soak_result {
  std::size_t pairs = 0, intersecting = 0, differences = 0, invalid_trees = 0;  ///< of all kinds
  std::vector<Soak_kind> kinds;
};

/// Holds `Contact_search`, between two objects and within one, against checking all face pairs whose boxes overlap.
///
/// Rounds are made from the seed: soups and surfaces of 200 to 2000 triangles, of every kind until it has its share of
/// `pairs`; in one unit, in very small and very large ones, and far from the origin; with 1 to 16 regions, leaves of 2
/// to 128 faces, one and several threads. The same seed gives the same rounds.
///
/// @param pairs     at least so many face pairs with overlapping boxes
/// @param progress  called with the pairs checked so far
Soak_result soak(std::uint64_t seed, std::size_t pairs, const std::function<void(std::size_t)>& progress = {});

}  // namespace lodestone
