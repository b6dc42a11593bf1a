// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/scenes/object_options.h"

#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

Object_options object_options(const Scene_object& object) {
  Object_options options{.particles = object.particles,
                         .groups = object.collision.groups,
                         .meets = object.collision.meets,
                         .file_vertex = object.file_vertex,
                         .name = object.name};
  if (const auto& side = object.scattered_side) options.scattered_side = coordinates(*side);
  return options;
}

}  // namespace lodestone
