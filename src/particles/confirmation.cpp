// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/confirmation.h"

#include <algorithm>

#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

namespace {

/// One bit per side of the box that the point lies beyond. Points that share a bit lie on one side: apart from the box.
std::uint8_t outcode(const Eigen::Vector3d& p, const Box& box) {
  unsigned code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    code |= static_cast<unsigned>(p[axis] < box.min()[axis]) << (2 * axis);
    code |= static_cast<unsigned>(p[axis] > box.max()[axis]) << (2 * axis + 1);
  }
  return static_cast<std::uint8_t>(code);
}

Triangle triangle(const Posed_patch& posed, std::uint32_t place) {
  return face_triangle(posed.patch->corners[place], [&](auto corner) { return posed.positions[corner]; });
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
  for (std::uint32_t place = 0; place < posed.patch->corners.size(); ++place) {
    const auto& [a, b, c] = posed.patch->corners[place];
    if ((outcodes_[a] & outcodes_[b] & outcodes_[c]) != 0) continue;
    Box box(posed.positions[a]);
    box.extend(posed.positions[b]).extend(posed.positions[c]);
    faces.push_back({box, place});
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

  // Along the axis on which the overlap is longest fewest faces lie side by side.
  int axis = 0;
  overlap.sizes().maxCoeff(&axis);
  const auto begin = [axis](const Boxed_face& face) { return face.box.min()[axis]; };
  std::ranges::sort(faces_a_, {}, begin);
  std::ranges::sort(faces_b_, {}, begin);

  /// Tests `face` against those of `others` that begin within its extent along the axis; true: stop.
  const auto sweep = [&](const Boxed_face& face, std::span<const Boxed_face> others, bool face_is_a) {
    for (const Boxed_face& other : others) {
      if (begin(other) > face.box.max()[axis]) break;
      if (!overlap_across(axis, face.box, other.box)) continue;
      const auto place_a = face_is_a ? face.place : other.place;
      const auto place_b = face_is_a ? other.place : face.place;
      ++exact_tests_;
      if (!triangles_intersect(triangle(a, place_a), triangle(b, place_b))) continue;
      found.push_back({a.patch->faces[place_a], b.patch->faces[place_b]});
      if (query != Contact_query::all) return true;
    }
    return false;
  };

  // Of two faces that overlap along the axis one begins first: it meets the other while that one is still ahead in its
  // list.
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
