// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/confirmation.h"

#include <algorithm>

#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

namespace {

/// One bit per side of the box beyond which the point lies. Points that share a bit are all on one side, apart from the
/// box.
std::uint8_t outcode(const Eigen::Vector3d& p, const Box& box) {
  unsigned code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    code |= static_cast<unsigned>(p[axis] < box.min()[axis]) << (2 * axis);
    code |= static_cast<unsigned>(p[axis] > box.max()[axis]) << (2 * axis + 1);
  }
  return static_cast<std::uint8_t>(code);
}

Triangle triangle(const Posed_patch& posed, std::uint32_t index) {
  return face_triangle(posed.patch->corners[index], [&](auto corner) { return posed.positions[corner]; });
}

bool overlap_across(int axis, const Box& a, const Box& b) {
  const int second = (axis + 1) % 3, third = (axis + 2) % 3;
  return a.min()[second] <= b.max()[second] && b.min()[second] <= a.max()[second] && a.min()[third] <= b.max()[third] &&
         b.min()[third] <= a.max()[third];
}

}  // namespace

void Confirmation::reserve(std::size_t faces, std::size_t vertices) {
  outcodes_.reserve(vertices);
  faces_a_.reserve(faces);
  faces_b_.reserve(faces);
}

void Confirmation::faces_within(const Posed_patch& posed, const Box& overlap, std::vector<Boxed_face>& faces) {
  faces.clear();
  outcodes_.clear();
  for (const auto& p : posed.positions) outcodes_.push_back(outcode(p, overlap));
  for (std::uint32_t index = 0; index < posed.patch->corners.size(); ++index) {
    const auto& [a, b, c] = posed.patch->corners[index];
    if ((outcodes_[a] & outcodes_[b] & outcodes_[c]) != 0) continue;
    Box box(posed.positions[a]);
    box.extend(posed.positions[b]).extend(posed.positions[c]);
    faces.push_back({box, index});
  }
}

bool Confirmation::confirm(const Posed_patch& a, const Posed_patch& b, Contact_query query,
                           std::vector<Face_pair>& found) {
  const std::size_t before = found.size();
  const Box overlap = a.box.intersection(b.box);
  if (overlap.isEmpty()) return false;
  faces_within(a, overlap, faces_a_);
  if (faces_a_.empty()) return false;
  Box tighter;
  for (const auto& face : faces_a_) tighter.extend(face.box);
  faces_within(b, overlap.intersection(tighter), faces_b_);

  // Along the axis on which the overlap is longest, the fewest faces overlap each other.
  int axis = 0;
  overlap.sizes().maxCoeff(&axis);
  const auto begin = [axis](const Boxed_face& face) { return face.box.min()[axis]; };
  std::ranges::sort(faces_a_, {}, begin);
  std::ranges::sort(faces_b_, {}, begin);

  /// Tests `face` against those of `others` that begin within its extent along the axis. True if the sweep may stop.
  const auto sweep = [&](const Boxed_face& face, std::span<const Boxed_face> others, bool face_is_a) {
    for (const Boxed_face& other : others) {
      if (begin(other) > face.box.max()[axis]) break;
      if (!overlap_across(axis, face.box, other.box)) continue;
      const auto index_a = face_is_a ? face.index : other.index;
      const auto index_b = face_is_a ? other.index : face.index;
      ++exact_tests_;
      if (!triangles_intersect(triangle(a, index_a), triangle(b, index_b))) continue;
      found.push_back({a.patch->faces[index_a], b.patch->faces[index_b]});
      if (query != Contact_query::all) return true;
    }
    return false;
  };

  // Of two faces that overlap along the axis, one begins first. It is tested against the other, which is still ahead in
  // its list.
  std::span<const Boxed_face> ahead_a = faces_a_;
  std::span<const Boxed_face> ahead_b = faces_b_;
  while (!ahead_a.empty() && !ahead_b.empty()) {
    const bool a_first = begin(ahead_a.front()) <= begin(ahead_b.front());
    auto& leading = a_first ? ahead_a : ahead_b;
    const Boxed_face& face = leading.front();
    leading = leading.subspan(1);
    if (sweep(face, a_first ? ahead_b : ahead_a, a_first)) return true;
  }
  return found.size() > before;
}

}  // namespace lodestone
