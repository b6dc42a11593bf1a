// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/concepts.h"

namespace lodestone {

/// How many of M vectors N code vectors are trained on.
/// @param most  `Lbg_options::sample`
std::size_t sample_size(std::size_t vectors, std::size_t cells, std::size_t most);

/// Draws one vector from each of `size` runs of consecutive vectors, whose lengths differ by at most 1. So the sample
/// follows the order of the vectors, and yet no pattern in this order. The same for the same arguments.
/// @param size  1 to `vectors`
/// @return `size` indices of vectors, ascending
std::vector<std::uint32_t> draw_sample(std::size_t vectors, std::size_t size);

/// Labels of all vectors to begin with: that of the vector drawn from the same run. Consecutive vertices of a mesh are
/// mostly near each other, so most of these labels are right.
/// @param sample_labels  of the vectors of `draw_sample`
std::vector<Region_index> labels_from_sample(std::size_t vectors, std::span<const Region_index> sample_labels);

}  // namespace lodestone
