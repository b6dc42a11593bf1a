// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <iterator>
#include <string>

#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// Throws the error of `check_connectivity`.
[[noreturn]] void fail_removed_elements(const std::string& who);
/// The same for other numbers of vertices or faces than the numbering has.
[[noreturn]] void fail_other_counts(const std::string& who, std::size_t vertices, std::size_t faces,
                                    std::size_t numbered_vertices, std::size_t numbered_faces);

/// Whether a mesh holds faces that were removed. O(1); O(F) for an OpenMesh whose faces have a status: it counts those
/// that are marked as removed, and only leaves them out where it lists the others.
template <Triangle_mesh Mesh>
bool holds_removed_faces(const Mesh& mesh) {
  if constexpr (requires { mesh.has_garbage(); }) return mesh.has_garbage();
  if constexpr (requires { mesh.has_face_status(); }) {
    if (!mesh.has_face_status()) return false;
    const auto listed = faces(mesh);
    return static_cast<std::size_t>(std::distance(listed.begin(), listed.end())) != num_faces(mesh);
  }
  return false;
}

/// Notices that a mesh has changed since it was numbered, by its numbers of vertices and faces. A change that keeps
/// both, such as a flipped edge, goes unnoticed. Costs what `holds_removed_faces` does.
/// @param who        names the mesh in the message; called only if there is one
/// @throws Bad_mesh  the mesh holds removed elements, or has another number of vertices or faces
template <Triangle_mesh Mesh, class Who>
void check_connectivity(const Mesh& mesh, const Mesh_numbering<Mesh>& numbering, Who who) {
  if (holds_removed_faces(mesh)) fail_removed_elements(who());
  const std::size_t vertices = num_vertices(mesh), faces = num_faces(mesh);
  if (vertices != numbering.vertex_count() || faces != numbering.corners().size())
    fail_other_counts(who(), vertices, faces, numbering.vertex_count(), numbering.corners().size());
}

}  // namespace lodestone
