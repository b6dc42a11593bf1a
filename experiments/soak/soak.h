// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "lodestone/mesh/pairs.h"

namespace lodestone {

/// What was checked of meshes of one kind.
struct Soak_kind {
  std::string_view name;
  std::size_t rounds = 0;         ///< pairs of meshes; a tree is built on one pose and refitted to others
  std::size_t pairs = 0;          ///< face pairs whose boxes overlap, checked one by one
  std::size_t intersecting = 0;   ///< of these
  std::size_t differences = 0;    ///< face pairs that only one side lists, or lists twice
  std::size_t invalid_trees = 0;  ///< trees that contradict their definition after a refit
};

struct Soak_result {
  std::size_t pairs = 0, intersecting = 0, differences = 0, invalid_trees = 0;  ///< of all kinds
  std::vector<Soak_kind> kinds;
};

/// Compares `Contact_search`, between two objects and within one, with a check of all face pairs whose boxes overlap.
///
/// The seed determines the rounds. Each kind of mesh plays rounds until it has checked its share of `pairs`. Meshes are
/// soups and surfaces of 200 to 2000 triangles, with coordinates about 1, very small, very large, or far from the
/// origin. Trees have 1 to 16 regions and leaves of 2 to 128 faces; one or several threads search them.
///
/// @param pairs     at least so many face pairs with overlapping boxes
/// @param progress  called with the pairs checked so far
Soak_result soak(std::uint64_t seed, std::size_t pairs, const std::function<void(std::size_t)>& progress = {});

/// The part of a soak that checks one kind of mesh, which depends on no other.
/// @param kind   0 to `soak_kinds()` - 1
/// @param share  at least so many face pairs with overlapping boxes
Soak_kind soak_one_kind(std::uint64_t seed, std::size_t kind, std::size_t share,
                        const std::function<void(std::size_t)>& progress = {});
std::size_t soak_kinds();

/// Face pairs that only one of two lists has, or that one has more often than the other.
std::size_t count_differences(std::span<const Face_pair> sorted_a, std::span<const Face_pair> sorted_b);

}  // namespace lodestone
