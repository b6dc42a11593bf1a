// SPDX-License-Identifier: GPL-3.0-or-later
// No model of Bounding_volume separates faces that meet: compared with exact predicates.
#include <limits>

#include "contract/volume_pairs.h"
#include "support/triangle_pairs.h"

namespace lodestone {
namespace {

/// One in so many of the pairs that are near is checked. This number is coprime to the number of queries per pair in
/// each test, so that all queries get checked.
constexpr std::size_t sampled_every = 7;

/// Minimum number of pairs in each test of triangles. Only pairs outside the range of double are skipped.
constexpr std::size_t hard_pairs_asked = 390'000, distance_pairs_asked = 170'000, images_asked = 290'000,
                      random_pairs_asked = 250'000;
static_assert(hard_pairs_asked + distance_pairs_asked + images_asked + random_pairs_asked >= 1'000'000);

template <class Volume>
class Bounding_volume_near : public ::testing::Test {
 protected:
  /// `near` in both orders, which must agree.
  bool are_near(const Volume& a, const Volume& b, double margin) {
    const bool result = near(a, b, margin);
    asymmetric_ += result == near(b, a, margin) ? 0 : 1;
    ++asked_, denied_ += result ? 0 : 1;
    return result;
  }

  /// Tests two triangles or soups. If they are not near, calls `meet`, which must return false.
  template <class Leaf, class Meet>
  void check(const Leaf& a, const Leaf& b, double margin, const char* kind, Meet meet) {
    const Volume volume_a = volume_of<Volume>(a), volume_b = volume_of<Volume>(b);
    if (are_near(volume_a, volume_b, margin)) {
      if (asked_ % sampled_every == 0) ++sampled_, met_ += meet(a, b) ? 1 : 0;
    } else if (meet(a, b)) {
      if (wrong_++ == 0)
        first_wrong_ << kind << ", margin " << std::hexfloat << margin << ": " << shown(a) << " | " << shown(b);
    }
  }
  void check(const Triangle& a, const Triangle& b, const char* kind) {
    if (!finite(a) || !finite(b)) return;
    check(a, b, 0, kind, [](const Triangle& s, const Triangle& t) { return triangles_intersect(s, t); });
  }
  void check_margin(const Triangle& a, const Triangle& b, double margin, const char* kind) {
    check(a, b, margin, kind, [&](const Triangle& s, const Triangle& t) { return within_margin(s, t, margin); });
  }
  static std::string shown(const Triangle& t) { return text(soup_of({t})); }
  static std::string shown(const Face_soup& soup) { return text(soup); }

  void TearDown() override {
    EXPECT_EQ(wrong_, 0U) << "of " << asked_ << "; the first: " << first_wrong_.str();
    EXPECT_EQ(asymmetric_, 0U) << "of " << asked_;
  }

  std::mt19937_64 random_{1};
  std::size_t asked_ = 0, denied_ = 0, sampled_ = 0, met_ = 0, wrong_ = 0, asymmetric_ = 0;
  std::ostringstream first_wrong_;
};
TYPED_TEST_SUITE(Bounding_volume_near, Volume_types, Volume_names);

TYPED_TEST(Bounding_volume_near, hard_pairs_that_meet_are_near) {
  constexpr int pairs_of_a_kind = 40'000;
  Hard_pairs pairs(1);
  for (const auto& kind : Hard_pairs::kinds())
    for (int i = 0; i < pairs_of_a_kind; ++i) {
      const auto [a, b] = (pairs.*kind.make)();
      const Placement place = any_placement(this->random_);
      this->check(placed(a, place), placed(b, place), kind.name);
    }
  EXPECT_GE(this->asked_, hard_pairs_asked);
  EXPECT_GT(this->denied_, this->asked_ / 50);
  EXPECT_GT(this->met_, this->sampled_ / 5);
}

TYPED_TEST(Bounding_volume_near, pairs_that_meet_are_near_even_if_their_distance_is_hard_to_decide) {
  constexpr int pairs_of_a_kind = 15'000;
  Triangle_pairs pairs(2);
  for (const auto& kind : Triangle_pairs::kinds)
    for (int i = 0; i < pairs_of_a_kind; ++i) {
      const auto [a, b] = (pairs.*kind.make)();
      const Placement place = any_placement(this->random_);
      this->check(placed(a, place), placed(b, place), kind.name);
    }
  EXPECT_GE(this->asked_, distance_pairs_asked);
  EXPECT_GT(this->denied_, this->asked_ / 50);
  EXPECT_GT(this->met_, this->sampled_ / 20);
}

TYPED_TEST(Bounding_volume_near, a_triangle_is_near_its_image_in_a_corner) {
  for (int i = 0; i < 300'000; ++i) {
    const auto t = placed(any_triangle(this->random_), any_placement(this->random_));
    const auto soup = soup_of({t});
    const auto image = mirrored(soup, static_cast<std::uint32_t>(i % 3)).triangle(0);
    this->check(t, image, "image in a corner");
  }
  EXPECT_GE(this->asked_, images_asked);
  EXPECT_EQ(this->denied_, 0U);
}

TYPED_TEST(Bounding_volume_near, random_pairs_that_meet_are_near) {
  for (int i = 0; i < 250'000; ++i) {
    const Placement place = any_placement(this->random_);
    const auto a = any_triangle(this->random_), b = any_triangle(this->random_);
    this->check(placed(a, place), placed(b, place), "anywhere");
  }
  EXPECT_GE(this->asked_, random_pairs_asked);
  EXPECT_GT(this->denied_, this->asked_ / 50);
  EXPECT_GT(this->met_, this->sampled_ / 50);
}

TYPED_TEST(Bounding_volume_near, groups_of_faces_that_meet_are_near) {
  const Face_groups group;
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 12'000; ++i) {
    const Placement place = any_placement(this->random_);
    const double x = unit(this->random_), y = unit(this->random_), z = unit(this->random_);
    const auto a = place(group(this->random_)), b = place(Placement{1, {x, y, z}}(group(this->random_)));
    this->check(a, b, 0, "groups", soups_meet);
  }
  EXPECT_GE(this->asked_, 12'000U);
  EXPECT_GT(this->denied_, this->asked_ / 50);
  EXPECT_GT(this->met_, this->sampled_ / 20);
}

TYPED_TEST(Bounding_volume_near, a_group_of_faces_is_near_its_image_in_a_corner) {
  const Face_groups group;
  for (int i = 0; i < 20'000; ++i) {
    const auto soup = any_placement(this->random_)(group(this->random_));
    const auto image = mirrored(soup, static_cast<std::uint32_t>(this->random_() % soup.vertex_count()));
    if (finite(image)) this->check(soup, image, 0, "image in a corner", soups_meet);
  }
  EXPECT_GE(this->asked_, 18'000U);
  EXPECT_EQ(this->denied_, 0U);
}

TYPED_TEST(Bounding_volume_near, volumes_far_apart_are_not_near) {
  const Face_groups group;
  for (const auto& place : {Placement{}, Placement{0x1p-300, {}}, Placement{0x1p300, {}}, Placement{1, {0x1p20, 0, 7}}})
    for (int i = 0; i < 1000; ++i) {
      Eigen::Vector3d away(1, 1, 1);
      for (double& x : away) x = std::normal_distribution<double>()(this->random_);
      away *= 40 / away.norm();
      const auto a = group(this->random_), b = Placement{1, {away.x(), away.y(), away.z()}}(group(this->random_));
      EXPECT_FALSE(this->are_near(volume_of<TypeParam>(place(a)), volume_of<TypeParam>(place(b)), 0)) << text(place);
      EXPECT_FALSE(this->are_near(volume_of<TypeParam>(place(a)), volume_of<TypeParam>(place(b)), 10 * place.scale));
    }
  EXPECT_EQ(this->asked_, 8000U);
}

TYPED_TEST(Bounding_volume_near, with_a_margin_only_faces_farther_apart_are_not_near) {
  constexpr int pairs_of_a_kind = 2'000;
  Triangle_pairs pairs(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const auto& kind : Triangle_pairs::kinds)
    for (int i = 0; i < pairs_of_a_kind; ++i) {
      auto [a, b] = (pairs.*kind.make)();
      const Placement place = any_placement(this->random_);
      a = placed(a, place), b = placed(b, place);
      if (!finite(a) || !finite(b)) continue;
      const double distance = closest_points(a, b).distance;
      if (!std::isfinite(distance)) continue;
      this->check_margin(a, b, distance, kind.name);
      this->check_margin(a, b, distance * (1 + std::pow(10, -16 * unit(this->random_))), kind.name);
      this->check_margin(a, b, distance * (1 - std::pow(10, -16 * unit(this->random_))), kind.name);
      this->check_margin(a, b, distance * unit(this->random_), kind.name);
    }
  EXPECT_GE(this->asked_, 80'000U);
  EXPECT_GT(this->denied_, this->asked_ / 50);
  EXPECT_GT(this->met_, this->sampled_ / 5);
}

TYPED_TEST(Bounding_volume_near, images_moved_away_from_a_corner_are_near_within_the_length_of_the_move) {
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 60'000; ++i) {
    const auto t = any_triangle(this->random_);
    const int corner = i % 3;
    auto image = mirrored(soup_of({t}), static_cast<std::uint32_t>(corner)).triangle(0);
    const Eigen::Vector3d axes[]{
        {1, 0, 0},
        {0, -1, 0},
        {0, 1, 1},
        {1, -1, 1},
        {unit(this->random_), unit(this->random_), 1},
        coordinates(t[corner]) - (coordinates(t[0]) + coordinates(t[1]) + coordinates(t[2])) / 3};
    const Eigen::Vector3d step = axes[this->random_() % 6] * std::pow(10, 8 * unit(this->random_) - 4);
    for (auto& p : image) p = Point(p.x() + step.x(), p.y() + step.y(), p.z() + step.z());
    const Placement place = any_placement(this->random_);
    const auto a = placed(t, place), b = placed(image, place);
    if (!finite(a) || !finite(b)) continue;
    const double distance = distance_rounded_up(a[corner], b[corner]);
    if (!std::isfinite(distance)) continue;
    EXPECT_TRUE(this->are_near(volume_of<TypeParam>(a), volume_of<TypeParam>(b), distance))
        << this->shown(a) << this->shown(b);
    this->check_margin(a, b, distance * (0.5 + 0.5 * unit(this->random_)), "moved image");
  }
  EXPECT_GE(this->asked_, 100'000U);
  EXPECT_GT(this->denied_, this->asked_ / 50);
}

TYPED_TEST(Bounding_volume_near, with_a_margin_only_groups_farther_apart_are_not_near) {
  const Face_groups group;
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 2'000; ++i) {
    const Placement place = any_placement(this->random_);
    const double x = 2 * unit(this->random_), y = 2 * unit(this->random_), z = 2 * unit(this->random_);
    const auto a = place(group(this->random_)), b = place(Placement{1, {x, y, z}}(group(this->random_)));
    const double margin = place.scale * std::pow(10, -2 * std::abs(unit(this->random_)));
    this->check(a, b, margin, "groups", [&](const auto& s, const auto& t) { return within_margin(s, t, margin); });
  }
  EXPECT_GE(this->asked_, 2'000U);
  EXPECT_GT(this->denied_, this->asked_ / 50);
  EXPECT_GT(this->met_, this->sampled_ / 20);
}

}  // namespace
}  // namespace lodestone
