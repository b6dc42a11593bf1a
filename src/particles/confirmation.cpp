// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/confirmation.h"

#include <algorithm>
#include <atomic>

#include "lodestone/mesh/faces_in_box.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

namespace {

/// @param posed  has a vertex
Coordinates coordinates_of(const Posed_patch& posed) {
  static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));
  return {posed.positions.front().data(), 3 * posed.positions.size()};
}

Triangle triangle(const Posed_patch& posed, std::uint32_t index) {
  return face_triangle(posed.patch->corners[index], [&](auto corner) { return posed.positions[corner]; });
}

/// Where a face begins along an axis.
struct Begin {
  int axis;

  template <class Boxed>
  double operator()(const Boxed& face) const {
    return face.box.min()[axis];
  }
};

bool overlap_across(int axis, const Box& a, const Box& b) {
  const int second = (axis + 1) % 3, third = (axis + 2) % 3;
  return a.min()[second] <= b.max()[second] && b.min()[second] <= a.max()[second] && a.min()[third] <= b.max()[third] &&
         b.min()[third] <= a.max()[third];
}

}  // namespace

void Confirmation::reserve(std::size_t faces, std::size_t vertices) {
  sides_.reserve(vertices);
  faces_a_.reserve(faces);
  faces_b_.reserve(faces);
  turns_.reserve(2 * faces);
}

void Confirmation::faces_within(const Posed_patch& posed, const Box& overlap, std::vector<Boxed_face>& faces) {
  faces.clear();
  sides_beyond(coordinates_of(posed), overlap, sides_);
  for (std::uint32_t index = 0; index < posed.patch->corners.size(); ++index) {
    const auto& [a, b, c] = posed.patch->corners[index];
    if ((sides_[a] & sides_[b] & sides_[c]) != 0) continue;
    Box box(posed.positions[a]);
    box.extend(posed.positions[b]).extend(posed.positions[c]);
    faces.push_back({box, index});
  }
}

bool Confirmation::confirm(const Posed_patch& a, const Posed_patch& b, Contact_query query,
                           std::vector<Face_pair>& found, Workers& workers) {
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
  sort_faces(axis, workers);
  list_turns(axis);
  const Question question{.a = a, .b = b, .axis = axis, .all = query == Contact_query::all};
  if (workers.count() > 1) return sweep_in_parts(question, found, workers);
  return sweep(question, turns_, found, exact_tests_);
}

void Confirmation::sort_faces(int axis, Workers& workers) {
  const auto sort_one = [&](std::size_t index, std::size_t) {
    std::ranges::sort(index == 0 ? faces_a_ : faces_b_, {}, Begin{axis});
  };
  constexpr std::size_t worth_sharing = 256;  // sorting them takes some ten microseconds
  const bool shared = std::min(faces_a_.size(), faces_b_.size()) >= worth_sharing;
  (shared ? workers : Workers::alone()).run(2, std::cref(sort_one));
}

/// Of two faces that overlap along the axis, one begins first. It is tested against the other, which is still ahead in
/// its list.
void Confirmation::list_turns(int axis) {
  const Begin begin{axis};
  turns_.clear();
  std::span<const Boxed_face> ahead_a = faces_a_;
  std::span<const Boxed_face> ahead_b = faces_b_;
  while (!ahead_a.empty() && !ahead_b.empty()) {
    const bool a_first = begin(ahead_a.front()) <= begin(ahead_b.front());
    auto& leading = a_first ? ahead_a : ahead_b;
    turns_.push_back({.face = &leading.front(), .ahead = a_first ? ahead_b : ahead_a, .of_a = a_first});
    leading = leading.subspan(1);
  }
}

/// Tests the face of each turn against those ahead that begin within its extent along the axis.
/// @return whether a pair was found
bool Confirmation::sweep(const Question& question, std::span<const Turn> turns, std::vector<Face_pair>& found,
                         std::size_t& exact_tests) {
  const Begin begin{question.axis};
  const std::size_t before = found.size();
  for (const Turn& turn : turns)
    for (const Boxed_face& other : turn.ahead) {
      if (begin(other) > turn.face->box.max()[question.axis]) break;
      if (!overlap_across(question.axis, turn.face->box, other.box)) continue;
      const auto index_a = turn.of_a ? turn.face->index : other.index;
      const auto index_b = turn.of_a ? other.index : turn.face->index;
      ++exact_tests;
      if (!triangles_intersect(triangle(question.a, index_a), triangle(question.b, index_b))) continue;
      found.push_back({question.a.patch->faces[index_a], question.b.patch->faces[index_b]});
      if (!question.all) return true;
    }
  return found.size() > before;
}

/// Parts after one that has found what was asked for do not count.
bool Confirmation::sweep_in_parts(const Question& question, std::vector<Face_pair>& found, Workers& workers) {
  constexpr std::size_t turns_per_part = 128;
  const std::size_t count = (turns_.size() + turns_per_part - 1) / turns_per_part;
  parts_.resize(std::max(parts_.size(), count));
  std::atomic<std::size_t> last = count;
  const auto sweep_part = [&](std::size_t index, std::size_t) {
    if (index > last) return;
    Part& part = parts_[index];
    part.found.clear();
    part.exact_tests = 0;
    const auto turns = std::span(turns_).subspan(index * turns_per_part);
    const bool any = sweep(question, turns.first(std::min(turns_per_part, turns.size())), part.found, part.exact_tests);
    if (!any || question.all) return;
    std::size_t before = last;
    while (index < before && !last.compare_exchange_weak(before, index)) {
    }
  };
  workers.run(count, std::cref(sweep_part));
  const std::size_t counted = std::min(count, last + 1), before = found.size();
  for (const Part& part : std::span(parts_).first(counted)) {
    exact_tests_ += part.exact_tests;
    found.insert(found.end(), part.found.begin(), part.found.end());
  }
  return found.size() > before;
}

}  // namespace lodestone
