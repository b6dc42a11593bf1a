// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <numeric>
#include <string>

#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// Throws the error of `check_connectivity`.
[[noreturn]] void fail_removed_elements(const std::string& who);
/// The same for other numbers of vertices or faces than the numbering has.
[[noreturn]] void fail_other_counts(const std::string& who, std::size_t vertices, std::size_t faces,
                                    std::size_t numbered_vertices, std::size_t numbered_faces);

/// Whether a mesh holds faces that were removed. O(1); of an OpenMesh whose faces have a status O(F), since only the
/// marks of the faces tell: a fast pass over them.
template <Triangle_mesh Mesh>
bool holds_removed_faces(const Mesh& mesh) {
  if constexpr (requires { mesh.has_garbage(); }) return mesh.has_garbage();
  if constexpr (requires(Face<Mesh> f) {
                  mesh.has_face_status();
                  mesh.status(f).bits();
                }) {
    if (!mesh.has_face_status() || num_faces(mesh) == 0) return false;
    const auto* const marks = &mesh.status(Face<Mesh>(0));  // one after the other
    const std::size_t count = num_faces(mesh);
    std::array<unsigned int, 8> found = {};  // vectorised also with little optimisation
    std::size_t f = 0;
    for (; f + found.size() <= count; f += found.size())
      for (std::size_t i = 0; i < found.size(); ++i) found[i] |= marks[f + i].bits();
    for (; f < count; ++f) found[0] |= marks[f].bits();
    auto any = *marks;
    any.set_bits(std::accumulate(found.begin(), found.end(), 0U, std::bit_or()));
    return any.deleted();
  }
  return false;
}

/// Notices that a mesh has changed since it was numbered, by its numbers of vertices and faces. A change that keeps
/// both, such as a flipped edge, goes unnoticed. Costs what `holds_removed_faces` does.
/// @param who        names the mesh in the message; called only if there is one
/// @throws Bad_mesh  the mesh holds removed faces, a Surface_mesh any removed elements; or it has another number of
///                   vertices or faces
template <Triangle_mesh Mesh, class Who>
void check_connectivity(const Mesh& mesh, const Mesh_numbering<Mesh>& numbering, Who who) {
  if (holds_removed_faces(mesh)) fail_removed_elements(who());
  const std::size_t vertices = num_vertices(mesh), faces = num_faces(mesh);
  if (vertices != numbering.vertex_count() || faces != numbering.corners().size())
    fail_other_counts(who(), vertices, faces, numbering.vertex_count(), numbering.corners().size());
}

}  // namespace lodestone
