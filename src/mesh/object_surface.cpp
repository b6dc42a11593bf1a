// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/object_surface.h"

#include "lodestone/mesh/components.h"
#include "lodestone/mesh/is_closed.h"

namespace lodestone {

const Vertex_fans& Object_surface::fans() const {
  if (!fans_) fans_.emplace(static_cast<std::uint32_t>(vertex_count()), corners_);
  return *fans_;
}

bool Object_surface::closed() const {
  if (!closed_) closed_ = is_closed(static_cast<std::uint32_t>(vertex_count()), corners_);
  return *closed_;
}

std::span<const std::uint32_t> Object_surface::component_vertices() const {
  if (!component_vertices_.empty()) return component_vertices_;
  component_vertices_ = lodestone::component_vertices(static_cast<std::uint32_t>(vertex_count()), corners_);
  return component_vertices_;
}

}  // namespace lodestone
