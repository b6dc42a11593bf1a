// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/contact/tree_object.h"

namespace lodestone {

/// Whether a point that is not on the surface lies inside it: whether the ray from it upwards along z crosses an odd
/// number of faces, exactly. O(log F + crossed leaves).
/// @param surface  closed, see `Tree_object::closed`
bool encloses(const Tree_object& surface, const Point& point);

/// Whether every piece of `inner` lies inside `outer`, whose surfaces do not intersect. Exact. False where `outer` is
/// not closed: it has no inside. A hollow in `outer`, bounded by a piece of its surface, is outside.
bool encloses(const Tree_object& outer, const Tree_object& inner);

}  // namespace lodestone
