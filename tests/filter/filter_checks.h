// SPDX-License-Identifier: GPL-3.0-or-later
// Leaves of any triangles, and what Face_filter keeps of them on every instruction set.
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

using Face_pairs = std::vector<Face_pair>;

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
  std::span<const Corners> faces() const { return soup_.faces; }
  Triangle triangle(std::size_t face) const { return soup_.triangle(face); }
  Tree_view view() const { return {&tree_, soup_.coordinates}; }

 private:
  Face_soup soup_;
  Region_tree tree_;
};

/// Candidates by their indices in the meshes, in the same order.
inline Face_pairs face_pairs(std::span<const Face_candidate> candidates, const Tree_view& a, std::uint32_t leaf_a,
                             const Tree_view& b, std::uint32_t leaf_b) {
  Face_pairs pairs;
  for (const auto& candidate : candidates)
    pairs.push_back({a.tree->faces(leaf_a)[candidate.a], b.tree->faces(leaf_b)[candidate.b]});
  return pairs;
}

/// The candidates of two trees of one leaf each, sorted. Checks that every instruction set gives the same in the same
/// order, and none twice.
inline Face_pairs candidate_pairs(const Tree_view& a, const Tree_view& b, double margin) {
  Face_filter face_filter;
  std::vector<Face_pairs> answers;
  for_instruction_sets([&] {
    face_filter.begin(a, b, margin);
    answers.push_back(face_pairs(face_filter.face_candidates(0, 0), a, 0, b, 0));
  });
  for (const auto& answer : answers) EXPECT_EQ(answer, answers[0]);
  std::ranges::sort(answers[0]);
  EXPECT_EQ(std::ranges::adjacent_find(answers[0]), answers[0].end()) << "a pair twice";
  return answers[0];
}

struct Placement {
  double scale, offset;
};
inline const std::vector<Placement> placements{{1, 0},        {1, 0x1p20},  {1, -0x1p40},   {0x1p-300, 0},
                                               {0x1p-340, 0}, {0x1p300, 0}, {0x1p-1050, 0}, {0x1p1020, 0}};

inline Triangle placed(Triangle t, const Placement& placement) {
  for (auto& p : t) {
    const auto moved = [&](double x) { return placement.scale * x + placement.offset; };
    p = {moved(p.x()), moved(p.y()), moved(p.z())};
  }
  return t;
}

}  // namespace lodestone
