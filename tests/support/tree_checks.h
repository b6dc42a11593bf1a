// SPDX-License-Identifier: GPL-3.0-or-later
// Objects with every degeneracy that a tree must accept, and checks that must hold for any tree.
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "lodestone/tree/region_tree.h"
#include "support/face_soup.h"

namespace lodestone {

struct Tree_case {
  std::string name;
  Face_soup soup;
};

std::vector<Tree_case> tree_cases();

Aabb box_around(std::span<const std::uint32_t> vertices, Coordinates coordinates);

void expect_equal(const Aabb& a, const Aabb& b);

void expect_equal_boxes(const Region_tree& a, const Region_tree& b);

/// Checks all guarantees about faces, vertices and boxes that `validate` does not.
void expect_tree(const Region_tree& tree, const Face_soup& soup, Coordinates coordinates);

}  // namespace lodestone
