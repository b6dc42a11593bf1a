// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "lodestone/queries/rounded_box.h"

/// The passes of an Overlap_search over lists of faces, built for several instruction sets and chosen at run time. All
/// give the same lists.
namespace lodestone::kernel {

/// The corners of a face as vertex indices.
using Face_corners = std::array<std::uint32_t, 3>;

/// How boxes are rounded.
struct Box_rounding {
  double scale;      ///< a power of two
  double origin[4];  ///< scaled; what lies below is moved there
  double size[4];    ///< scaled; what lies farther from the origin is moved there
};

/// Boxes faces.
/// @param boxes  `count` of them; their indices count from 0
/// @return the box around all
Rounded_box box_faces(const double* coordinates, const Face_corners* corners, std::size_t count,
                      const Box_rounding& rounding, Rounded_box* boxes);

/// Copies the boxes that meet another box.
/// @param to      may be `from`, for a cull in place
/// @param around  set to the box around them, if there are any
/// @return number of boxes copied
std::size_t cull(const Rounded_box* from, std::size_t count, const Rounded_box& other, Rounded_box* to,
                 Rounded_box& around);

/// The boxes on either side of a plane, and the box around each.
struct Halves {
  std::size_t below = 0, above = 0;
  Rounded_box around_below, around_above;
};
/// Copies the boxes whose centres lie below a plane, and moves the others together.
/// @param twice_at  twice where the plane crosses the axis
/// @param to        room for `count` boxes
Halves split(Rounded_box* from, std::size_t count, int axis, float twice_at, Rounded_box* to);

}  // namespace lodestone::kernel
