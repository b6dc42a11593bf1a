// SPDX-License-Identifier: GPL-3.0-or-later
// When the rays at one pose, and those at earlier ones, pay for a Ray_tree. 1600 faces: a tree that is there pays for
// more than 25 rays, and a new one for more than 100.
#include "lodestone/detection/kept_ray_tree.h"

#include <gtest/gtest.h>

#include "lodestone/io/shapes/shapes.h"
#include "support/face_soup.h"

namespace lodestone {
namespace {

constexpr std::size_t faces = 1600;  // of an object; the tree of the last test has fewer

TEST(Kept_ray_tree, pays_as_soon_as_enough_rays_were_asked_at_one_pose) {
  Kept_ray_tree tree;
  for (int ray = 1; ray <= 100; ++ray) EXPECT_FALSE(tree.pays_for(1, faces)) << ray;
  EXPECT_TRUE(tree.pays_for(1, faces));
  EXPECT_FALSE(Kept_ray_tree().pays_for(100, faces));
  EXPECT_TRUE(Kept_ray_tree().pays_for(101, faces));
}

TEST(Kept_ray_tree, never_pays_for_a_single_ray) {
  Kept_ray_tree tree;
  EXPECT_FALSE(tree.pays_for(1, 12));
  EXPECT_TRUE(tree.pays_for(1, 12));  // the second
}

TEST(Kept_ray_tree, adds_up_the_rays_of_poses_for_which_a_refit_would_have_paid) {
  Kept_ray_tree tree;
  for (int pose = 0; pose < 3; ++pose, tree.note_moved()) EXPECT_FALSE(tree.pays_for(26, faces));
  EXPECT_FALSE(tree.pays_for(22, faces));  // at this pose they are too few
  EXPECT_FALSE(tree.pays_for(3, faces));
  EXPECT_TRUE(tree.pays_for(1, faces));  // 78 and 26
  Kept_ray_tree of_few;
  for (int pose = 0; pose < 100; ++pose, of_few.note_moved()) EXPECT_FALSE(of_few.pays_for(25, faces));
}

TEST(Kept_ray_tree, that_has_the_pose_pays_for_every_ray_and_one_of_another_pose_for_many) {
  const Posed_object object{Face_soup(icosphere(3))};
  Kept_ray_tree tree;
  const Ray_tree* first = &tree.of(object.view(), Workers::alone());
  EXPECT_TRUE(tree.pays_for(1, faces));
  tree.note_moved();
  for (int ray = 1; ray <= 25; ++ray) EXPECT_FALSE(tree.pays_for(1, faces)) << ray;
  EXPECT_TRUE(tree.pays_for(1, faces));
  EXPECT_EQ(&tree.of(object.view(), Workers::alone()), first);
  EXPECT_TRUE(tree.pays_for(1, faces));
  tree.forget();
  EXPECT_FALSE(tree.pays_for(26, faces));
  Kept_ray_tree of_other_faces;
  EXPECT_FALSE(of_other_faces.pays_for(25, faces));
  of_other_faces.forget();
  EXPECT_FALSE(of_other_faces.pays_for(77, faces));  // not 102
}

}  // namespace
}  // namespace lodestone
