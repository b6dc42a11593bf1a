// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <span>

#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// The region with which a tree groups a face: the lowest of its corners' regions.
inline Region_index region_of(const Corners& face, std::span<const Region_index> labels) {
  return std::min({labels[face[0]], labels[face[1]], labels[face[2]]});
}

}  // namespace lodestone
