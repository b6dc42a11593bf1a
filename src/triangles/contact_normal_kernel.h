// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

namespace lodestone::kernel {

/// As many pairs as the widest vectors hold.
inline constexpr std::size_t most_normals = 8;

/// Pairs of triangles. The last index is that of the pair.
struct Triangle_pairs {
  std::size_t count = 0;                                          ///< of pairs; what follows them is ignored
  double a[3][3][most_normals] = {}, b[3][3][most_normals] = {};  ///< [corner][axis]
};

/// See Contact_normal.
struct Normals_and_depths {
  double normal[3][most_normals], depth[most_normals];
  std::array<bool, most_normals> proven;  ///< false: a triangle is thin, tiny or huge, and the result means nothing
};

void contact_normals(const Triangle_pairs& faces, Normals_and_depths& result);

}  // namespace lodestone::kernel
