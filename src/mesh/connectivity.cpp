// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/connectivity.h"

namespace lodestone {

void fail_removed_elements(const std::string& who) {
  throw Bad_mesh(who +
                 " holds removed elements: collect them first (collect_garbage() of a Surface_mesh, "
                 "garbage_collection() of an OpenMesh), then call rebuild()");
}

void fail_other_counts(const std::string& who, std::size_t vertices, std::size_t faces, std::size_t numbered_vertices,
                       std::size_t numbered_faces) {
  throw Bad_mesh(who + " has " + std::to_string(vertices) + " vertices and " + std::to_string(faces) +
                 " faces, but had " + std::to_string(numbered_vertices) + " and " + std::to_string(numbered_faces) +
                 ": call rebuild() after such a change");
}

}  // namespace lodestone
