// SPDX-License-Identifier: GPL-3.0-or-later
// The models of Bounding_volume as sets of points: volumes around them, and `near`.
#include "contract/volume_pairs.h"

namespace lodestone {
namespace {

/// A point with double coordinates that is just inside a volume: the last one on the segment from a point inside to one
/// outside.
template <class Volume>
Point last_inside(const Volume& volume, const Point& from, const Point& to) {
  const auto at = [&](double t) {
    return Point(from.x() + t * (to.x() - from.x()), from.y() + t * (to.y() - from.y()),
                 from.z() + t * (to.z() - from.z()));
  };
  double low = 0, high = 1;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (inside(volume, exact_point(at(middle))) ? low : high) = middle;
  }
  return at(low);
}

template <class Volume>
class Bounding_volume_set : public ::testing::Test {
 protected:
  Bounding_volume_set() {
    leaves_ = solid_leaves();
    for (auto& leaf : flat_leaves()) leaves_.push_back(std::move(leaf));
  }

  /// A leaf about (0, 0, 0), rotated, moved slightly, scaled and translated.
  Face_soup any_leaf(const Placement& place) {
    const auto& soup = leaves_[random_() % leaves_.size()].soup;
    return place(posed_at_random(placed(soup, 0.5), 0.5, random_));
  }
  /// A point of a face of a soup, often one of its corners, up to rounding.
  Point any_vertex(const Face_soup& soup) {
    const auto& face = soup.faces[random_() % soup.faces.size()];
    return soup.point(face[random_() % 3]);
  }
  /// A point at the border of a volume around a leaf, and one beyond it.
  std::pair<Point, Point> border_point(const Volume& volume, const Face_soup& soup, const Placement& place) {
    const Point from = any_vertex(soup);
    const auto along = [&] { return place.scale * std::normal_distribution<double>()(random_); };
    const double x = along(), y = along(), z = along();
    const Point to(from.x() + 4 * x, from.y() + 4 * y, from.z() + 4 * z);
    return {last_inside(volume, from, to), to};
  }
  /// A triangle with a given corner, whose others lie farther in the direction of another point.
  Triangle beyond(const Point& corner, const Point& ahead) {
    Triangle t{corner, corner, corner};
    for (int i = 1; i < 3; ++i) {
      double moved[3];
      for (int axis = 0; axis < 3; ++axis)
        moved[axis] =
            corner[axis] + (ahead[axis] - corner[axis]) * std::uniform_real_distribution<double>(0.2, 1)(random_);
      t[i] = Point(moved[0], moved[1], moved[2]);
    }
    return t;
  }

  std::vector<Volume_leaf> leaves_;
  std::mt19937_64 random_{1};
};
TYPED_TEST_SUITE(Bounding_volume_set, Volume_types, Volume_names);

const std::vector<Placement> places{
    {},         {}, {1, {0x1p20, 0x1p20, 0x1p20}}, {1, {1e6, -1e6, 0}}, {0x1p-300, {}}, {0x1p300, {}}, {0x1p-537, {}},
    {1e154, {}}};

TYPED_TEST(Bounding_volume_set, the_volume_around_two_contains_every_point_of_both) {
  for (int i = 0; i < 1500; ++i) {
    const auto& place = places[this->random_() % places.size()];
    const Face_soup soups[]{this->any_leaf(place), this->any_leaf(place)};
    const TypeParam parts[]{volume_of<TypeParam>(soups[0]), volume_of<TypeParam>(soups[1])};
    const auto both = volume_of<TypeParam>(parts[0], parts[1]);
    for (int part = 0; part < 2; ++part)
      for (int k = 0; k < 2; ++k) {
        const Point p = this->border_point(parts[part], soups[part], place).first;
        EXPECT_TRUE(inside(both, exact_point(p))) << p << ", " << text(place);
      }
  }
}

TYPED_TEST(Bounding_volume_set, the_volume_around_one_and_another_that_barely_protrudes_contains_both) {
  std::uniform_real_distribution<double> exponent(-16, -6);
  for (int i = 0; i < 3000; ++i) {
    const auto& place = places[this->random_() % places.size()];
    const auto soup = this->any_leaf(place);
    const auto volume = volume_of<TypeParam>(soup);
    const auto [p, ahead] = this->border_point(volume, soup, place);
    const double step = std::pow(10, exponent(this->random_));
    const Point q(p.x() + step * (ahead.x() - p.x()), p.y() + step * (ahead.y() - p.y()),
                  p.z() + step * (ahead.z() - p.z()));
    const auto other = volume_of<TypeParam>(this->beyond(q, this->any_vertex(soup)));
    EXPECT_TRUE(inside(volume_of<TypeParam>(volume, other), exact_point(q))) << q << ", " << text(place);
    EXPECT_TRUE(inside(volume_of<TypeParam>(other, volume), exact_point(q))) << q << ", " << text(place);
  }
}

TYPED_TEST(Bounding_volume_set, volumes_with_a_point_in_common_are_near) {
  for (int i = 0; i < 3000; ++i) {
    const auto& place = places[this->random_() % places.size()];
    const auto soup = this->any_leaf(place);
    const auto volume = volume_of<TypeParam>(soup);
    const auto [p, ahead] = this->border_point(volume, soup, place);
    const auto other = volume_of<TypeParam>(this->beyond(p, ahead));
    EXPECT_TRUE(near(volume, other, 0)) << p << ", " << text(place);
    EXPECT_TRUE(near(other, volume, 0)) << p << ", " << text(place);
  }
}

TYPED_TEST(Bounding_volume_set, volumes_with_points_within_the_margin_are_near) {
  std::uniform_real_distribution<double> exponent(-5, 1), unit(-1, 1);
  for (int i = 0; i < 3000; ++i) {
    const auto& place = places[this->random_() % places.size()];
    const auto soup = this->any_leaf(place);
    const auto volume = volume_of<TypeParam>(soup);
    const auto [p, ahead] = this->border_point(volume, soup, place);
    const double step = std::pow(10, exponent(this->random_));
    const Point q(p.x() + step * (ahead.x() - p.x()), p.y() + step * (ahead.y() - p.y()),
                  p.z() + step * (ahead.z() - p.z()));
    const Point farther(q.x() + ahead.x() - p.x(), q.y() + ahead.y() - p.y(), q.z() + ahead.z() - p.z());
    const auto other = volume_of<TypeParam>(this->beyond(q, farther));
    const double margin = distance_rounded_up(p, q);
    EXPECT_TRUE(near(volume, other, margin)) << p << " | " << q << ", " << text(place);
    EXPECT_TRUE(near(other, volume, margin)) << p << " | " << q << ", " << text(place);
  }
}

TYPED_TEST(Bounding_volume_set, volumes_around_volumes_that_share_a_point_are_near) {
  for (int i = 0; i < 2000; ++i) {
    const auto& place = places[this->random_() % places.size()];
    const auto soup = this->any_leaf(place);
    const auto volume = volume_of<TypeParam>(soup);
    const auto [p, ahead] = this->border_point(volume, soup, place);
    auto a = volume, b = volume_of<TypeParam>(this->beyond(p, ahead));
    for (int level = 0; level < 4; ++level) {
      auto& grown = this->random_() % 2 == 0 ? a : b;
      grown = volume_of<TypeParam>(grown, volume_of<TypeParam>(this->any_leaf(place)));
      EXPECT_TRUE(near(a, b, 0)) << p << ", " << text(place);
      EXPECT_TRUE(near(b, a, 0)) << p << ", " << text(place);
    }
  }
}

TYPED_TEST(Bounding_volume_set, nan_never_proves_volumes_apart) {
  const auto a = volume_of<TypeParam>(solid_leaves()[0].soup);
  const auto b = volume_of<TypeParam>(Placement{1, {100, 100, 100}}(solid_leaves()[0].soup));
  ASSERT_FALSE(near(a, b, 1));
  EXPECT_TRUE(near(a, b, std::numeric_limits<double>::infinity()));
  EXPECT_TRUE(near(a, b, std::numeric_limits<double>::max()));
  EXPECT_TRUE(near(a, b, 1e200));
  EXPECT_FALSE(near(a, b, std::numeric_limits<double>::denorm_min()));
}

}  // namespace
}  // namespace lodestone
