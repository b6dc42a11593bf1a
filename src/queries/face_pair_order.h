// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "lodestone/mesh/pairs.h"

namespace lodestone {

/// Sorts face pairs by a, then by b. O(n log n), with vector instructions.
void sort_face_pairs(std::span<Face_pair> pairs);

}  // namespace lodestone
