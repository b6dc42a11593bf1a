// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>

#include "lodestone/mesh/pairs.h"
#include "lodestone/tree/tree_view.h"

namespace lodestone {

/// A face by its leaf and its place in the list of the leaf.
struct Leaf_face {
  std::uint32_t leaf = 0, index = 0;
};

/// Two faces that intersect.
struct Lowest_contact {
  Face_pair faces;
  Leaf_face a, b;
};

/// The lowest of the face pairs of two surfaces that intersect; none if none do. Exact. Costs as much as finding all
/// contacts.
/// @param a, b  with boxes
std::optional<Lowest_contact> lowest_contact(const Layout_view& a, const Layout_view& b);

/// The same within one surface: of faces that share no vertex, the lower one first.
std::optional<Lowest_contact> lowest_contact_within(const Layout_view& surface);

}  // namespace lodestone
