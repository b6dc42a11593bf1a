// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs of leaves of any triangles, and what Face_filter lists of them on every instruction set.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/filter/face_filter.h"
#include "support/face_soup.h"
#include "support/instruction_sets.h"

namespace lodestone {

using Numbers = std::vector<Face_pair>;

/// A tree of a single leaf whose faces share no vertex, refitted to triangles.
class Single_leaf {
 public:
  explicit Single_leaf(std::uint32_t faces) {
    soup_.coordinates.resize(9 * std::size_t{faces});
    for (std::uint32_t i = 0; i < faces; ++i) soup_.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    tree_ = Region_tree(soup_.faces, {}, soup_.coordinates, {.leaf_faces = 128});
  }

  void set(std::size_t face, const Triangle& t) {
    double* x = soup_.coordinates.data() + 9 * face;
    for (const auto& corner : t)
      for (int axis = 0; axis < 3; ++axis) *x++ = corner[axis];
  }
  void refit() { ASSERT_TRUE(tree_.refit(soup_.coordinates)); }
  std::size_t size() const { return soup_.faces.size(); }
  Triangle triangle(std::size_t face) const { return soup_.triangle(face); }
  Tree_view view() const { return {&tree_, soup_.coordinates}; }

 private:
  Face_soup soup_;
  Region_tree tree_;
};

/// Faces by number instead of place, in the order in which they are listed.
inline Numbers listed_order(std::span<const Face_candidate> places, const Tree_view& a, std::uint32_t leaf_a,
                            const Tree_view& b, std::uint32_t leaf_b) {
  Numbers pairs;
  for (const auto& place : places) pairs.push_back({a.tree->faces(leaf_a)[place.a], b.tree->faces(leaf_b)[place.b]});
  return pairs;
}

/// The same, sorted.
inline Numbers numbered(std::span<const Face_candidate> places, const Tree_view& a, std::uint32_t leaf_a,
                        const Tree_view& b, std::uint32_t leaf_b) {
  Numbers pairs = listed_order(places, a, leaf_a, b, leaf_b);
  std::ranges::sort(pairs);
  return pairs;
}

/// The near pairs of two trees of one leaf, the same for each instruction set and in the same order; sorted.
inline Numbers near_pairs(const Tree_view& a, const Tree_view& b, double margin) {
  Face_filter face_filter;
  std::vector<Numbers> answers;
  for_instruction_sets([&] {
    face_filter.begin(a, b, margin);
    answers.push_back(listed_order(face_filter.face_candidates(0, 0), a, 0, b, 0));
  });
  for (const auto& answer : answers) EXPECT_EQ(answer, answers[0]);
  std::ranges::sort(answers[0]);
  EXPECT_EQ(std::ranges::adjacent_find(answers[0]), answers[0].end()) << "a pair twice";
  return answers[0];
}

struct Place {
  double scale, offset;
};
inline const std::vector<Place> places{{1, 0},        {1, 0x1p20},  {1, -0x1p40},   {0x1p-300, 0},
                                       {0x1p-340, 0}, {0x1p300, 0}, {0x1p-1050, 0}, {0x1p1020, 0}};

inline Triangle placed(Triangle t, const Place& place) {
  for (auto& p : t) {
    const auto moved = [&](double x) { return place.scale * x + place.offset; };
    p = {moved(p.x()), moved(p.y()), moved(p.z())};
  }
  return t;
}

}  // namespace lodestone
