// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace lodestone {

/// The groups of an object, as bits of 32 groups: see Object_options.
struct Collision_groups {
  std::uint32_t groups = 1;                 ///< those that it belongs to
  std::uint32_t meets = ~std::uint32_t{0};  ///< those that it can collide with
};

/// Whether each of two objects belongs to a group that the other meets; for an object and itself too.
constexpr bool meet(const Collision_groups& a, const Collision_groups& b) {
  return (a.groups & b.meets) != 0 && (b.groups & a.meets) != 0;
}

}  // namespace lodestone
