// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "lodestone/contact/confirmation.h"

namespace lodestone {

/// Sorts face pairs, as `std::sort` would: by a, then by b. O(n) for numbers of so many bits: there is nothing in it
/// that a processor would have to foresee.
void sort_face_pairs(std::span<Face_pair> pairs);

}  // namespace lodestone
