// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/ring_check.h"

#include <algorithm>

namespace lodestone {

void Ring_check::start(Rings& rings, std::uint32_t vertex) {
  rings.faces.clear();
  rings.vertices.assign(1, vertex);
  rings.fresh.assign(1, vertex);
}

/// Whether the next ring does not make them more than are tested, even if its vertices share no faces.
bool Ring_check::is_small_enough(const Walked_surface& surface, const Rings& rings) {
  std::size_t faces = rings.faces.size();
  for (const auto vertex : rings.fresh) faces += surface.vertex_faces->at(vertex).size();
  return faces <= most_faces;
}

/// Adds the faces at the vertices of the last ring that are not there yet: those without a corner in an earlier ring.
void Ring_check::grow(const Walked_surface& surface, Rings& rings) {
  rings.rim.clear();
  for (const auto vertex : rings.fresh)
    for (const auto face : surface.vertex_faces->at(vertex)) {
      const auto is_it = [&](const Read_face& there) { return there.face == face; };
      if (std::ranges::any_of(rings.faces, is_it)) continue;
      rings.faces.push_back(read_face(surface, face));
      vertices_read_ += 3;
      for (const auto corner : surface.walked[face])
        if (std::ranges::find(rings.vertices, corner) == rings.vertices.end()) {
          rings.vertices.push_back(corner);
          rings.rim.push_back(corner);
        }
    }
  rings.fresh.swap(rings.rim);
}

bool Ring_check::test(std::span<const Read_face> faces_a, std::span<const Read_face> faces_b, Face_pair& found) {
  Box around_b;
  for (const Read_face& b : faces_b) around_b.extend(b.box);
  for (const Read_face& a : faces_a) {
    if (!a.box.intersects(around_b)) continue;
    for (const Read_face& b : faces_b) {
      if (!a.box.intersects(b.box)) continue;
      ++exact_tests_;
      if (!triangles_intersect(a.triangle, b.triangle)) continue;
      found = {a.face, b.face};
      return true;
    }
  }
  return false;
}

bool Ring_check::check(const Walked_surface& a, const Walked_surface& b, Meeting at, std::size_t rings,
                       Face_pair& found) {
  start(a_, at.a);
  start(b_, at.b);
  for (std::size_t ring = 0; ring < rings; ++ring) {
    if (!is_small_enough(a, a_) || !is_small_enough(b, b_)) return false;
    const std::size_t old_a = a_.faces.size(), old_b = b_.faces.size();
    grow(a, a_);
    grow(b, b_);
    const std::span all_a(a_.faces), all_b(b_.faces);
    // The new faces of a with all of b, then the old ones of a with the new ones of b.
    if (test(all_a.subspan(old_a), all_b, found) || test(all_a.first(old_a), all_b.subspan(old_b), found)) return true;
  }
  return false;
}

}  // namespace lodestone
