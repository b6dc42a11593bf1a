// SPDX-License-Identifier: GPL-3.0-or-later
// Whether six drawn corners are triangles that meet, by exact numbers.
#pragma once

#include <string>

#include "fuzz/drawn_triangles.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone::fuzz {

/// Whether the two triangles have a point in common. A double is an integer times a power of two, so exact
/// integers suffice: of 64 bits, of 256, or of any number.
bool truly_meet(const Six_corners& corners);

/// The triangle that begins at a corner, as the library has it.
Triangle triangle(const Six_corners& corners, std::size_t first);

/// All coordinates without rounding, for a message.
std::string text_of(const Six_corners& corners);

}  // namespace lodestone::fuzz
