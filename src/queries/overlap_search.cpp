// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/overlap_search.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "lodestone/mesh/large_pages.h"
#include "lodestone/triangles/triangle_distance.h"
#include "lodestone/triangles/triangle_intersection.h"
#include "lodestone/volumes/to_box.h"
#include "queries/face_pair_order.h"
#include "queries/rounded_box_kernel.h"

namespace lodestone {

namespace {

/// Half of the longest side of a box; the whole could overflow.
double half_side(const Box& box) { return (box.max() / 2 - box.min() / 2).maxCoeff(); }

/// A power of two that brings the longest side of a box near 1, unless its coordinates would overflow.
double scale_of(const Box& box) {
  const double longest = half_side(box);
  const double largest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  if (longest <= 0) return 1;
  return std::ldexp(1.0, std::clamp(std::min(-std::ilogb(longest), 1000 - std::ilogb(largest)), -1000, 1000));
}

Triangle_corners corners_of(const Faces_in_box& faces, std::uint32_t index) {
  const double* at = faces.coordinates.data();
  const Corners& corners = faces.corners[index];
  return {at + 3 * std::size_t{corners[0]}, at + 3 * std::size_t{corners[1]}, at + 3 * std::size_t{corners[2]}};
}

/// A box is narrow when it is shorter than this share of the frame: eight of a float's 24 digits are left for its
/// faces. A larger share would box more faces again than the search has to halve.
constexpr double narrow_share = 0x1p-16;
/// A frame that is not smaller by this is not worth a pass.
constexpr double least_gain = 0x1p-8;

}  // namespace

std::optional<Contact_summary> Overlap_search::run(const Faces_in_box& a, const Box& box_a, const Faces_in_box& b,
                                                   const Box& box_b, Contact_query query,
                                                   std::vector<Face_pair>& found) {
  const std::size_t first = found.size();
  found_ = &found;
  one_is_enough_ = query != Contact_query::all;
  leaf_tests_ = exact_tests_ = 0;
  has_given_up_ = false;
  if (a.faces.size() * b.faces.size() <= few_pairs) {
    test_all(a, b);
  } else {
    Kept& kept = kept_of_thread();
    filter_ = &kept.filter, stacks_ = kept.stacks;
    const Emptied when_done{stacks_};
    filter_->begin(a.coordinates, to_aabb(box_a), b.coordinates, to_aabb(box_b));
    const Box overlap = box_a.intersection(box_b);
    const bool sliced = one_is_enough_ && std::min(a.faces.size(), b.faces.size()) > few_faces;
    const bool in_slice = sliced && search_slice(a, b, overlap);
    if (!in_slice) search_all(a, b, overlap);
  }
  if (has_given_up_) return std::nullopt;
  const Contact_summary summary{.found = found.size() > first, .leaf_tests = leaf_tests_, .exact_tests = exact_tests_};
  if (query == Contact_query::yes_no) found.resize(first);
  sort_face_pairs(std::span(found).subspan(first));
  return summary;
}

Overlap_search::Kept& Overlap_search::kept_of_thread() {
  static thread_local Kept kept;
  return kept;
}

/// Gives the faces whose boxes meet to the exact test, without a list of boxes.
void Overlap_search::test_all(const Faces_in_box& a, const Faces_in_box& b) {
  if (a.faces.empty() || b.faces.empty()) return;
  faces_[0] = &a, faces_[1] = &b;
  ++leaf_tests_;
  for (std::uint32_t i = 0; i < a.faces.size(); ++i)
    for (std::uint32_t j = 0; j < b.faces.size(); ++j)
      if (boxes_meet(corners_of(a, i), corners_of(b, j)) && test_pair(i, j, no_crossing)) return;
}

/// Searches a slice across the longest side of the overlap. Where surfaces cross, the curve is mostly about as long as
/// the overlap, and so passes through the slice.
/// @return whether there is a contact
bool Overlap_search::search_slice(const Faces_in_box& a, const Faces_in_box& b, const Box& overlap) {
  constexpr double share = 1.0 / 32;
  Eigen::Index axis = 0;
  const Eigen::Vector3d half = overlap.max() / 2 - overlap.min() / 2;
  half.maxCoeff(&axis);
  Box slice = overlap;
  slice.min()[axis] += (1 - share) * half[axis];
  slice.max()[axis] -= (1 - share) * half[axis];
  if (slice.isEmpty()) return false;  // by rounding
  Faces_in_box slice_a, slice_b;
  select_faces(a, slice, slice_a);
  select_faces(b, slice, slice_b);
  return search_all(slice_a, slice_b, slice);
}

/// @return whether the search is over
bool Overlap_search::search_all(const Faces_in_box& a, const Faces_in_box& b, const Box& overlap) {
  if (overlap.isEmpty() || a.faces.empty() || b.faces.empty()) return false;
  faces_[0] = &a, faces_[1] = &b;
  const bool few = std::max(a.faces.size(), b.faces.size()) <= few_faces;
  group_by(one_is_enough_ && few && exact_tests_ < patience ? small_group_faces : group_faces);
  round_in(overlap);
  Pair_of_parts whole{box_faces(0), box_faces(1)};
  return search(whole, {true, true});
}

void Overlap_search::Stack::reserve(std::size_t count) {
  if (top_ + count <= capacity_) return;
  std::size_t bytes = sizeof(Rounded_box) * std::max(top_ + count, 2 * capacity_);
  Release release;
  if (bytes > large_page / 4) {
    bytes = (bytes + large_page - 1) / large_page * large_page;
    release.alignment = std::align_val_t(large_page);
  }
  std::unique_ptr<Rounded_box[], Release> larger(static_cast<Rounded_box*>(::operator new(bytes, release.alignment)),
                                                 release);
  // Each search is the first to write this memory: to get it in small pages can take longer than all else.
  use_large_pages(larger.get(), bytes);
  std::copy_n(boxes_.get(), top_, larger.get());
  boxes_ = std::move(larger);
  capacity_ = bytes / sizeof(Rounded_box);
}

void Overlap_search::Stack::clear() {
  top_ = 0;
  if (capacity_ * sizeof(Rounded_box) <= large_page) return;
  boxes_.reset();
  capacity_ = 0;
}

void Overlap_search::round_in(const Box& frame) {
  frame_ = frame;
  narrow_side_ = static_cast<float>(2 * half_side(frame) * scale_of(frame) * narrow_share);
}

/// Boxes faces; the indices of the boxes are those in the list of corners.
Rounded_box Overlap_search::box_at(int side, std::span<const Corners> corners, Rounded_box* boxes) const {
  kernel::Box_rounding rounding{.scale = scale_of(frame_), .origin = {}, .size = {}};
  for (int axis = 0; axis < 3; ++axis) {
    rounding.origin[axis] = frame_.min()[axis] * rounding.scale;
    rounding.size[axis] = frame_.max()[axis] * rounding.scale - rounding.origin[axis];
  }
  return kernel::box_faces(faces_[side]->coordinates.data(), corners.data(), corners.size(), rounding, boxes);
}

Overlap_search::Part Overlap_search::box_faces(int side) {
  const auto& corners = faces_[side]->corners;
  Stack& stack = stacks_[side];
  stack.drop_to(0);
  stack.reserve(3 * corners.size());  // halves and copies lie on top
  return stack.push(corners.size(), box_at(side, corners, stack.at(0)));
}

/// Boxes faces again, in place, after the frame has changed.
void Overlap_search::box_again(int side, Part& part) {
  const std::span boxes(stacks_[side].at(part.begin), part.count);
  std::vector<Corners> corners;
  std::vector<std::uint32_t> indices;
  for (const Rounded_box& box : boxes) {
    indices.push_back(box.index);
    corners.push_back(faces_[side]->corners[box.index]);
  }
  part.box = box_at(side, corners, boxes.data());
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i].index = indices[i];
}

/// The box around faces as they are, not rounded.
Box Overlap_search::box_around(int side, const Part& part) {
  Box around;
  for (const Rounded_box& box : std::span(stacks_[side].at(part.begin), part.count))
    for (const double* corner : corners_of(*faces_[side], box.index)) around.extend(Eigen::Vector3d::Map(corner));
  return around;
}

bool Overlap_search::is_narrow(const Rounded_box& box) const {
  return box.side(0) < narrow_side_ && box.side(1) < narrow_side_ && box.side(2) < narrow_side_;
}

/// Goes on in a smaller frame: the boxes of two lists that have become narrow are rounded anew. Fine parts of a coarse
/// surface would all have the same rounded box otherwise, and no list could be halved.
/// @return whether the search is over; none: the frame would be hardly smaller
std::optional<bool> Overlap_search::search_again(Pair_of_parts& parts) {
  const Box outer = frame_, inner = box_around(0, parts[0]).intersection(box_around(1, parts[1]));
  if (inner.isEmpty()) return false;
  if (!(half_side(inner) < least_gain * half_side(outer))) return std::nullopt;
  round_in(inner);
  for (const int side : {0, 1}) box_again(side, parts[side]);
  const bool over = search(parts, {true, true});
  round_in(outer);
  return over;
}

/// Halves the longer list. Each half is compared with what it may meet of the other list.
/// @param to_cull  which lists have not been compared with the box around the other
/// @return whether the search is over
bool Overlap_search::search(Pair_of_parts& parts, Sides to_cull) {
  while (cull(parts, to_cull)) {
    const int longer = parts[1].count > parts[0].count ? 1 : 0, other = 1 - longer;
    if (parts[longer].count <= most_faces_) return test(parts);
    if (is_narrow(parts[longer].box))
      if (const auto over = search_again(parts)) return *over;
    const std::size_t tops[]{stacks_[0].top(), stacks_[1].top()};
    Pair_of_parts halves;
    halves[longer] = take_half(longer, parts[longer]);
    halves[other] = copy_meeting(other, parts[other], halves[longer].box);
    const bool over = halves[other].count > 0 && search(halves, only(longer));
    for (int side = 0; side < 2; ++side) stacks_[side].drop_to(tops[side]);
    if (over) return true;
    to_cull = only(other);
  }
  return false;
}

/// Drops the faces that lie outside the box around the other list, until few are left to drop.
/// @return whether any pair may meet
bool Overlap_search::cull(Pair_of_parts& parts, Sides to_cull) {
  for (int side = to_cull[0] ? 0 : 1; to_cull[side]; side = 1 - side) {
    Part& part = parts[side];
    Rounded_box* boxes = stacks_[side].at(part.begin);
    const std::size_t count = kernel::cull(boxes, part.count, parts[1 - side].box, boxes, part.box);
    to_cull[side] = false;
    if (8 * (part.count - count) > part.count) to_cull[1 - side] = true;
    part.count = count;
    if (count == 0) return false;
  }
  return true;
}

/// Copies the faces that may meet a box to the top of their stack.
Overlap_search::Part Overlap_search::copy_meeting(int side, const Part& from, const Rounded_box& other) {
  Stack& stack = stacks_[side];
  stack.reserve(from.count);
  Rounded_box around;
  const std::size_t count = kernel::cull(stack.at(from.begin), from.count, other, stack.at(stack.top()), around);
  return stack.push(count, around);
}

/// Takes about half of the faces out of a list, to the top of their stack: those on one side of the middle of the box,
/// or of the median where the middle would leave too few.
Overlap_search::Part Overlap_search::take_half(int side, Part& whole) {
  int axis = 0;
  for (int other = 1; other < 3; ++other)
    if (whole.box.side(other) > whole.box.side(axis)) axis = other;
  Stack& stack = stacks_[side];
  stack.reserve(whole.count);
  const kernel::Halves halves =
      kernel::split(stack.at(whole.begin), whole.count, axis, whole.box.twice_centre(axis), stack.at(stack.top()));
  if (8 * std::min(halves.below, halves.above) < whole.count) {
    std::copy_n(stack.at(stack.top()), halves.below, stack.at(whole.begin) + halves.above);
    return take_median(side, whole, axis);
  }
  whole.count = halves.above;
  whole.box = halves.around_above;
  return stack.push(halves.below, halves.around_below);
}

Overlap_search::Part Overlap_search::take_median(int side, Part& whole, int axis) {
  Rounded_box* boxes = stacks_[side].at(whole.begin);
  // Ties are broken by index, so that the halves do not depend on the sorting routine.
  const auto key = [axis](const Rounded_box& box) { return std::pair(box.twice_centre(axis), box.index); };
  std::vector<std::pair<float, std::uint32_t>> keys(whole.count);
  std::transform(boxes, boxes + whole.count, keys.begin(), key);
  const std::size_t half = whole.count / 2;
  std::ranges::nth_element(keys, keys.begin() + static_cast<std::ptrdiff_t>(half));
  std::partition(boxes, boxes + whole.count, [&](const Rounded_box& box) { return key(box) < keys[half]; });
  const Part taken = copy_meeting(side, {whole.begin + half, whole.count - half, {}}, whole.box);
  whole.count = half;
  return taken;
}

/// Gives two short lists to the filter, and what it leaves to the exact test.
/// @return whether the search is over
bool Overlap_search::test(const Pair_of_parts& parts) {
  if (gives_up()) return true;
  if (parts[0].count * parts[1].count <= few_pairs) return test_few(parts);
  for (int side = 0; side < 2; ++side) {
    groups_[side].clear();
    for (const Rounded_box& box : std::span(stacks_[side].at(parts[side].begin), parts[side].count))
      groups_[side].push_back(faces_[side]->corners[box.index]);
  }
  const auto index = [&](int side, std::size_t i) { return stacks_[side].at(parts[side].begin + i)->index; };
  ++leaf_tests_;
  for (const Face_candidate& candidate : filter_->face_candidates(groups_[0], groups_[1]))
    if (test_pair(index(0, candidate.a), index(1, candidate.b), candidate.crossing)) return true;
  return false;
}

/// From now on lists are halved until they have no more faces than this.
void Overlap_search::group_by(std::size_t most_faces) {
  most_faces_ = most_faces;
  most_leaf_tests_ =
      leaf_tests_ + most_partners * (2 + (faces_[0]->faces.size() + faces_[1]->faces.size()) / most_faces);
}

bool Overlap_search::gives_up() {
  has_given_up_ = leaf_tests_ >= most_leaf_tests_;
  return has_given_up_;
}

/// Gives the faces whose boxes meet to the exact test. If there have been many for nothing, lists are halved no further
/// than for the filter from now on.
/// @return whether the search is over
bool Overlap_search::test_few(const Pair_of_parts& parts) {
  ++leaf_tests_;
  if (exact_tests_ >= patience && most_faces_ < group_faces) group_by(group_faces);
  for (const Rounded_box& box_a : std::span(stacks_[0].at(parts[0].begin), parts[0].count))
    for (const Rounded_box& box_b : std::span(stacks_[1].at(parts[1].begin), parts[1].count))
      if (meet(box_a, box_b) && test_pair(box_a.index, box_b.index, no_crossing)) return true;
  return false;
}

/// @param a, b  places in the lists of faces
/// @return whether the search is over
bool Overlap_search::test_pair(std::uint32_t a, std::uint32_t b, Crossing likely) {
  ++exact_tests_;
  if (!triangles_intersect_given(corners_of(*faces_[0], a), corners_of(*faces_[1], b), likely)) return false;
  found_->push_back({faces_[0]->faces[a], faces_[1]->faces[b]});
  return one_is_enough_;
}

}  // namespace lodestone
