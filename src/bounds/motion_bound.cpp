// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/bounds/motion_bound.h"

#include <fmt/format.h>

#include <algorithm>

#include "lodestone/mesh/errors.h"

namespace lodestone {

void check_layout(const Tree_layout& layout, std::size_t vertex_count) {
  const std::uint32_t greatest = std::ranges::max(layout.all_vertices());
  if (greatest >= vertex_count)
    throw Bad_argument(fmt::format("the layout has a vertex {}, the motion has {} vertices", greatest, vertex_count));
}

}  // namespace lodestone
