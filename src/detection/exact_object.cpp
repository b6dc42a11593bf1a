// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/exact_object.h"

namespace lodestone {

std::vector<std::uint32_t> changed_faces(std::span<const Corners> former, std::span<const Corners> now) {
  std::vector<std::uint32_t> changed;
  for (std::uint32_t face = 0; face < now.size(); ++face)
    if (face >= former.size() || former[face] != now[face]) changed.push_back(face);
  return changed;
}

}  // namespace lodestone
