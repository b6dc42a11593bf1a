// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <compare>
#include <cstdint>

/// Types in which every stage reports what it finds.
namespace lodestone {

/// Two faces by index: `a` of the first object, `b` of the second.
struct Face_pair {
  std::uint32_t a = 0;                                 ///< face index in the first object
  std::uint32_t b = 0;                                 ///< face index in the second object
  auto operator<=>(const Face_pair&) const = default;  ///< by a, then by b
};

/// Two objects of a scene by index, a < b; or a = b for an object and itself.
struct Object_pair {
  std::uint32_t a = 0;                                   ///< the lower index
  std::uint32_t b = 0;                                   ///< the higher index, or the same
  auto operator<=>(const Object_pair&) const = default;  ///< by a, then by b
};

/// What a query asks for.
enum class Contact_query {
  yes_no,  ///< whether there is a contact
  first,   ///< one contact
  all,     ///< every contact
};

}  // namespace lodestone
