// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <compare>
#include <cstdint>

/// The words that every stage uses for what it finds.
namespace lodestone {

/// Two faces by index: `a` of the first object, `b` of the second.
struct Face_pair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  auto operator<=>(const Face_pair&) const = default;
};

/// Two objects of a scene by index, a < b; a = b: an object and itself.
struct Object_pair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  auto operator<=>(const Object_pair&) const = default;
};

/// How much a query wants to know.
enum class Contact_query {
  yes_no,  ///< whether anything intersects
  first,   ///< one intersecting face pair
  all,     ///< every intersecting face pair
};

}  // namespace lodestone
