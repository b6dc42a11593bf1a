// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <vector>

#include "lodestone/filter/face_group_filter.h"
#include "lodestone/mesh/box.h"
#include "lodestone/mesh/faces_in_box.h"
#include "lodestone/mesh/pairs.h"
#include "lodestone/queries/contact_search.h"
#include "lodestone/queries/rounded_box.h"

namespace lodestone {

/// Finds the contacts of two surfaces that are asked about once, without a tree.
///
/// The faces of both are halved again and again, the longer list along the longer side of its box, but only as far as
/// the answer needs: what lies outside the box of the other list is dropped first. Short lists go to the filter and the
/// exact test. If there are at most 64 face pairs, nothing is halved.
///
/// O(F) where surfaces cross along a curve, or one contact is enough; at most O(F log F) steps of some nanoseconds
/// before the filters. It gives up where boxes part little, as those of faces around one vertex: at most O(F) pairs of
/// short lists go to the filters. Where one contact is enough, a part of the overlap is searched first, and the search
/// gives up too if boxes part little there.
class Overlap_search {
 public:
  /// Appends the face pairs that intersect to `found`, sorted; none for the query `yes_no`, one for `first`.
  /// @param a, b          faces by index in their meshes, of which those outside `overlap` may be missing
  /// @param box_a, box_b  around the two surfaces
  /// @return none: it has given up, and what it appended is not all
  std::optional<Contact_summary> run(const Faces_in_box& a, const Box& box_a, const Faces_in_box& b, const Box& box_b,
                                     Contact_query query, std::vector<Face_pair>& found);

  /// Pairs of short lists that the last run has tested, also one that gave up.
  std::size_t leaf_tests() const { return leaf_tests_; }
  /// Face pairs that it has given to exact predicates.
  std::size_t exact_tests() const { return exact_tests_; }

 private:
  /// Faces of one surface: so many from one place of its stack on, and the box around them.
  struct Part {
    std::size_t begin, count;
    Rounded_box box;
  };
  using Pair_of_parts = std::array<Part, 2>;
  using Sides = std::array<bool, 2>;
  static Sides only(int side) { return {side == 0, side == 1}; }

  /// Boxes of faces. What lies on top of a list goes before the list does.
  class Stack {
   public:
    Rounded_box* at(std::size_t place) { return boxes_.get() + place; }
    std::size_t top() const { return top_; }
    void drop_to(std::size_t top) { top_ = top; }
    /// Makes room for `count` boxes on top, which it leaves unset. Invalidates addresses.
    void reserve(std::size_t count);
    /// Empties it, and gives its memory back if that is more than a large page.
    void clear();
    /// Adds boxes that have been written on top.
    Part push(std::size_t count, const Rounded_box& around) {
      top_ += count;
      return {.begin = top_ - count, .count = count, .box = around};
    }

   private:
    struct Release {
      Release() : alignment(std::align_val_t(alignof(Rounded_box))) {}
      std::align_val_t alignment;
      void operator()(Rounded_box* boxes) const { ::operator delete(boxes, alignment); }
    };
    std::unique_ptr<Rounded_box[], Release> boxes_;
    std::size_t top_ = 0, capacity_ = 0;
  };

  /// What each thread keeps from one search to the next: some 200 kB, and two stacks, each of at most a large page. To
  /// get this memory from the system can take longer than the search.
  struct Kept {
    Face_group_filter filter;
    Stack stacks[2];
  };
  static Kept& kept_of_thread();
  /// Empties both stacks in the end, also where memory runs out.
  struct Emptied {
    Stack* stacks;
    ~Emptied() { stacks[0].clear(), stacks[1].clear(); }
  };

  void test_all(const Faces_in_box& a, const Faces_in_box& b);
  bool search_slice(const Faces_in_box& a, const Faces_in_box& b, const Box& overlap);
  bool search_all(const Faces_in_box& a, const Faces_in_box& b, const Box& overlap);
  void round_in(const Box& frame);
  Rounded_box box_at(int side, std::span<const Corners> corners, Rounded_box* boxes) const;
  Part box_faces(int side);
  void box_again(int side, Part& part);
  Box box_around(int side, const Part& part);
  bool is_narrow(const Rounded_box& box) const;
  std::optional<bool> search_again(Pair_of_parts& parts);
  bool search(Pair_of_parts& parts, Sides to_cull);
  bool cull(Pair_of_parts& parts, Sides to_cull);
  Part copy_meeting(int side, const Part& from, const Rounded_box& other);
  Part take_half(int side, Part& whole);
  Part take_median(int side, Part& whole, int axis);
  bool test(const Pair_of_parts& parts);
  bool test_few(const Pair_of_parts& parts);
  void group_by(std::size_t most_faces);
  bool gives_up();
  bool test_pair(std::uint32_t a, std::uint32_t b, Crossing likely);

  /// Lists no longer than this are not halved any further: to filter them takes about as long as to halve them.
  static constexpr std::size_t group_faces = 64;
  /// So few face pairs, of whole surfaces or of short lists, are tested without the filter, whose code and memory are
  /// seldom in the cache.
  static constexpr std::size_t few_pairs = 64;
  /// Where one contact is enough and surfaces have few faces, the filter is mostly not needed at all.
  static constexpr std::size_t small_group_faces = 8;
  /// After so many exact tests without a contact the filter is worth it: surfaces are close to each other, but meet
  /// nowhere or in few places.
  static constexpr std::size_t patience = 32;
  /// More pairs of short lists per short list are not filtered.
  static constexpr std::size_t most_partners = 16;
  /// Of surfaces with more faces than this, a slice is searched first if one contact is enough.
  static constexpr std::size_t few_faces = 512;

  const Faces_in_box* faces_[2] = {};
  Box frame_;                            ///< boxes are rounded in it: what lies outside is moved to its sides
  float narrow_side_ = 0;                ///< a rounded box whose sides are shorter is narrow
  Stack* stacks_ = nullptr;              ///< two, of this thread
  Face_group_filter* filter_ = nullptr;  ///< of this thread
  std::vector<Corners> groups_[2];
  std::vector<Face_pair>* found_ = nullptr;
  bool one_is_enough_ = false, has_given_up_ = false;
  std::size_t most_faces_ = 0;  ///< of a list that is not halved
  std::size_t leaf_tests_ = 0, most_leaf_tests_ = 0, exact_tests_ = 0;
};

}  // namespace lodestone
