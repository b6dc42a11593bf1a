// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/bounds/node_bound.h"

#include <fmt/format.h>

#include "lodestone/mesh/errors.h"

namespace lodestone {

void check_object(const Bounded_object& object) {
  const std::size_t vertices = object.positions.vertex_count();
  check_layout(object.layout, vertices);
  if (object.rest.size() != 3 * vertices)
    throw Bad_argument(
        fmt::format("{} coordinates at rest for {} vertices, must be three for each", object.rest.size(), vertices));
  if (!object.labels.empty() && object.labels.size() != vertices)
    throw Bad_argument(
        fmt::format("{} labels for {} vertices, must be one for each, or none", object.labels.size(), vertices));
}

}  // namespace lodestone
