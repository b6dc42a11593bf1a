// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/joined_vertices.h"

#include <gtest/gtest.h>

#include "lodestone/mesh/errors.h"

namespace lodestone {
namespace {

using Faces = std::vector<Corners>;
using Numbers = std::vector<std::uint32_t>;

const Faces two_faces{{0, 1, 2}, {3, 4, 5}};

TEST(Join_vertices, replaces_vertices_with_one_number_by_the_first_of_them) {
  EXPECT_EQ(join_vertices(two_faces, 6, Numbers{9, 7, 8, 8, 1, 9}), (Faces{{0, 1, 2}, {2, 4, 0}}));
  EXPECT_EQ(join_vertices(two_faces, 6, Numbers{5, 5, 5, 5, 5, 5}), (Faces{{0, 0, 0}, {0, 0, 0}}));
}

TEST(Join_vertices, changes_nothing_if_all_numbers_differ) {
  EXPECT_EQ(join_vertices(two_faces, 6, Numbers{}), Faces{});
  EXPECT_EQ(join_vertices(two_faces, 6, Numbers{5, 4, 3, 2, 1, 0xFFFFFFFF}), Faces{});
}

TEST(Join_vertices, refuses_a_wrong_number_of_entries) {
  EXPECT_THROW(join_vertices(two_faces, 6, Numbers{0, 1, 2, 3, 4}), Bad_argument);
  EXPECT_THROW(join_vertices(two_faces, 6, Numbers{0, 1, 2, 3, 4, 5, 6}), Bad_argument);
}

TEST(Unused_vertices, are_those_without_a_face) {
  EXPECT_EQ(unused_vertices(two_faces, 6), Numbers{});
  EXPECT_EQ(unused_vertices(two_faces, 8), (Numbers{6, 7}));
  EXPECT_EQ(unused_vertices(Faces{{5, 2, 2}}, 6), (Numbers{0, 1, 3, 4}));
}

}  // namespace
}  // namespace lodestone
