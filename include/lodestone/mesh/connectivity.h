// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// Throws the error of `check_connectivity`.
[[noreturn]] void fail_removed_elements(const std::string& who);
/// The same for other numbers of vertices or faces than the numbering has.
[[noreturn]] void fail_other_counts(const std::string& who, std::size_t vertices, std::size_t faces,
                                    std::size_t numbered_vertices, std::size_t numbered_faces);

/// Notices that a mesh has changed since it was numbered, by its numbers of vertices and faces. O(1). A change that
/// keeps both, such as a flipped edge, goes unnoticed.
/// @param who        names the mesh in the message; called only if there is one
/// @throws Bad_mesh  the mesh holds removed elements, or has another number of vertices or faces
template <Triangle_mesh Mesh, class Who>
void check_connectivity(const Mesh& mesh, const Mesh_numbering<Mesh>& numbering, Who who) {
  if constexpr (requires { mesh.has_garbage(); })
    if (mesh.has_garbage()) fail_removed_elements(who());
  const std::size_t vertices = num_vertices(mesh), faces = num_faces(mesh);
  if (vertices != numbering.vertex_count() || faces != numbering.corners().size())
    fail_other_counts(who(), vertices, faces, numbering.vertex_count(), numbering.corners().size());
}

}  // namespace lodestone
