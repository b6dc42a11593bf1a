// SPDX-License-Identifier: GPL-3.0-or-later
// What every model of Bounding_volume guarantees for a leaf, in exact arithmetic.
#include <limits>

#include "contract/volume_leaves.h"
#include "support/hard_pairs.h"
#include "support/instruction_sets.h"
#include "support/special_numbers.h"

namespace lodestone {
namespace {

/// Whether a box contains all corners of the faces.
bool surrounds(const Aabb& box, const Face_soup& soup) {
  for (const auto& face : soup.faces)
    for (const std::size_t v : face)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double x = soup.coordinates[3 * v + axis];
        if (!(box.low[axis] <= x && x <= box.high[axis])) return false;
      }
  return true;
}

template <class Volume>
class Bounding_volume_contract : public ::testing::Test {
 protected:
  /// Fits a volume to a leaf and checks that it contains the faces.
  Volume expect_enclosed(const std::string& name, const Face_soup& soup) {
    const auto volume = volume_of<Volume>(soup);
    EXPECT_TRUE(encloses(volume, soup, likely_centres(soup), random_)) << name;
    EXPECT_TRUE(surrounds(volume.bounds(), soup)) << name;
    EXPECT_TRUE(volume == volume_of<Volume>(soup)) << name << ": the same fit";
    EXPECT_TRUE(near(volume, volume, 0)) << name;
    EXPECT_TRUE(near(volume, volume, 1)) << name;
    EXPECT_GE(volume.extent(), 0) << name;
    return volume;
  }

  std::mt19937_64 random_{1};
};
TYPED_TEST_SUITE(Bounding_volume_contract, Volume_types, Volume_names);

std::vector<Volume_leaf> all_leaves() {
  auto leaves = solid_leaves();
  for (auto& leaf : flat_leaves()) leaves.push_back(std::move(leaf));
  return leaves;
}

TYPED_TEST(Bounding_volume_contract, every_point_of_every_face_lies_in_the_volume_of_its_leaf) {
  for (const auto& [name, soup] : all_leaves()) {
    ASSERT_LE(soup.faces.size(), 128U);
    EXPECT_GE(this->expect_enclosed(name, soup).volume(), 0) << name;
    for (int pose = 0; pose < 3; ++pose) {
      const auto turned = posed_at_random(soup, 1, this->random_);
      EXPECT_GE(this->expect_enclosed(name + ", turned", turned).volume(), 0) << name;
    }
  }
}

TYPED_TEST(Bounding_volume_contract, volumes_enclose_their_faces_far_from_the_origin) {
  for (const auto& [name, soup] : all_leaves())
    for (const auto& place : far_places()) {
      const auto moved = place(posed_at_random(soup, 0, this->random_));
      EXPECT_GE(this->expect_enclosed(name + ", " + text(place), moved).volume(), 0) << name;
    }
}

TYPED_TEST(Bounding_volume_contract, volumes_enclose_their_faces_for_the_largest_and_the_smallest_numbers) {
  for (const auto& [name, soup] : all_leaves())
    for (const auto& place : extreme_scales()) {
      const auto scaled = place(soup);
      if (finite(scaled)) this->expect_enclosed(name + ", " + text(place), scaled);
      const auto turned = place(posed_at_random(placed(soup, 0.5), 0, this->random_));
      ASSERT_TRUE(finite(turned)) << name;
      this->expect_enclosed(name + ", turned, " + text(place), turned);
    }
}

TYPED_TEST(Bounding_volume_contract, volumes_enclose_random_triangles) {
  Hard_pairs pairs(1);
  for (const auto& kind : Hard_pairs::kinds())
    for (int i = 0; i < 300; ++i) {
      const auto [a, b] = (pairs.*kind.make)();
      this->expect_enclosed(kind.name, soup_of({a}));
      this->expect_enclosed(kind.name, soup_of({a, b}));
    }
}

TYPED_TEST(Bounding_volume_contract, the_volume_around_two_encloses_the_faces_of_both) {
  const auto leaves = all_leaves();
  std::vector<Placement> places{{1, {}}, {1, {2, -1, 0.5}}, {0x1p-10, {1, 1, 1}}};
  for (const auto& place : far_places()) places.push_back(place);
  for (const auto& place : extreme_scales()) places.push_back(place);
  for (int i = 0; i < 400; ++i) {
    const auto pick = [&](const auto& list) { return list[this->random_() % list.size()]; };
    const Volume_leaf first = pick(leaves), second = pick(leaves);
    const Placement place_a = pick(places), place_b = i % 2 == 0 ? place_a : pick(places);
    const auto a = place_a(placed(first.soup, 0.5)),
               b = place_b(posed_at_random(placed(second.soup, 0.5), 0, this->random_));
    ASSERT_TRUE(finite(a) && finite(b));
    const auto both = volume_of<TypeParam>(volume_of<TypeParam>(a), volume_of<TypeParam>(b));
    const std::string name = first.name + ", " + text(place_a) + "; " + second.name + ", " + text(place_b);
    const auto parts = joined(a, b);
    EXPECT_TRUE(encloses(both, parts, likely_centres(parts), this->random_)) << name;
    EXPECT_TRUE(both == volume_of<TypeParam>(volume_of<TypeParam>(a), volume_of<TypeParam>(b))) << name;
    EXPECT_GE(both.extent(), 0) << name;
    EXPECT_TRUE(near(both, volume_of<TypeParam>(a), 0)) << name;
    EXPECT_TRUE(near(volume_of<TypeParam>(b), both, 0)) << name;
    EXPECT_TRUE(surrounds(both.bounds(), parts)) << name;
  }
}

TYPED_TEST(Bounding_volume_contract, a_volume_depends_only_on_the_vertices_of_its_faces) {
  for (const auto& [name, soup] : all_leaves()) {
    Face_soup spread;
    for (std::size_t i = 0; i < soup.coordinates.size(); i += 3) {
      const double nan = std::numeric_limits<double>::quiet_NaN();
      spread.coordinates.insert(spread.coordinates.end(), {nan, infinity, -infinity});
      spread.coordinates.insert(spread.coordinates.end(), soup.coordinates.begin() + static_cast<std::ptrdiff_t>(i),
                                soup.coordinates.begin() + static_cast<std::ptrdiff_t>(i) + 3);
    }
    for (const auto& [a, b, c] : soup.faces) spread.faces.push_back({2 * a + 1, 2 * b + 1, 2 * c + 1});
    EXPECT_TRUE(volume_of<TypeParam>(spread) == volume_of<TypeParam>(soup)) << name;
  }
}

TYPED_TEST(Bounding_volume_contract, every_instruction_set_fits_the_same_volume) {
  for (const auto& [name, soup] : all_leaves())
    for (const double scale : {1.0, 0x1p-300, 0x1p-1060}) {
      const auto leaf = placed(posed_at_random(soup, 1, this->random_), scale);
      const auto expected = volume_of<TypeParam>(leaf);
      for_instruction_sets([&] { EXPECT_TRUE(volume_of<TypeParam>(leaf) == expected) << name; });
    }
}

TYPED_TEST(Bounding_volume_contract, extents_are_0_for_points_and_grow_with_the_leaf) {
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 100; ++i) {
    const Point p(std::ldexp(unit(this->random_), i - 50), unit(this->random_), unit(this->random_));
    // Up to rounding.
    const double most = 1e-12 * (std::abs(p.x()) + 1);
    EXPECT_LE(volume_of<TypeParam>(Triangle{p, p, p}).extent(), most) << p;
    EXPECT_LE(volume_of<TypeParam>(soup_of({{p, p, p}, {p, p, p}, {p, p, p}})).extent(), most) << p;
  }
  for (const auto& [name, soup] : solid_leaves()) {
    const double extent = volume_of<TypeParam>(soup).extent();
    EXPECT_GT(extent, 0) << name;
    EXPECT_NEAR(volume_of<TypeParam>(placed(soup, 4)).extent() / extent, 4, 0.2) << name;
    EXPECT_NEAR(volume_of<TypeParam>(placed(soup, 0x1p-300)).extent() / extent * 0x1p300, 1, 0.05) << name;
    EXPECT_NEAR(volume_of<TypeParam>(placed(soup, 0x1p300)).extent() / extent * 0x1p-300, 1, 0.05) << name;
  }
}

/// The relative error by which a model may overestimate its volume.
template <class Volume>
constexpr double counted_too_much = 0;
template <>
constexpr double counted_too_much<Spherical_shell> = 0.1;  // the part of its cone outside its ball

TYPED_TEST(Bounding_volume_contract, the_reported_volume_is_that_of_the_set) {
  constexpr int samples = 60'000;
  std::uniform_real_distribution<double> unit(0, 1);
  for (const auto& [name, soup] : solid_leaves()) {
    const auto volume = volume_of<TypeParam>(soup);
    // Samples extend beyond the bounds, since a volume may reach beyond the faces that it encloses.
    const Aabb bounds = volume.bounds();
    double low[3], width[3];
    for (int axis = 0; axis < 3; ++axis) {
      const double side = bounds.high[axis] - bounds.low[axis];
      low[axis] = bounds.low[axis] - 0.02 * side, width[axis] = 1.04 * side;
    }
    int within = 0;
    for (int i = 0; i < samples; ++i) {
      const double x = unit(this->random_), y = unit(this->random_), z = unit(this->random_);
      const Point p(low[0] + x * width[0], low[1] + y * width[1], low[2] + z * width[2]);
      within += inside(volume, exact_point(p)) ? 1 : 0;
    }
    const double share = static_cast<double>(within) / samples, room = width[0] * width[1] * width[2];
    const double deviation = std::sqrt(share * (1 - share) / samples);
    EXPECT_GE(volume.volume() / room, share - 4 * deviation - 1e-4) << name;
    EXPECT_LE(volume.volume() / room, (1 + counted_too_much<TypeParam>)*share + 4 * deviation + 1e-4) << name;
  }
}

TYPED_TEST(Bounding_volume_contract, a_leaf_moved_without_rounding_keeps_its_volume) {
  for (const auto& [name, source] : solid_leaves()) {
    // Multiples of 2^-30, so that adding numbers up to 2^20 does not round.
    auto soup = source;
    for (double& x : soup.coordinates) x = std::ldexp(std::round(std::ldexp(x, 30)), -30);
    const auto here = volume_of<TypeParam>(soup);
    for (const double offset : {1.0, 0x1p10, -0x1p20}) {
      const auto there = volume_of<TypeParam>(Placement{1, {offset, -offset, 0.5 * offset}}(soup));
      EXPECT_LE(there.volume(), (1 + 0.05) * here.volume()) << name << ", " << offset;
      EXPECT_LE(there.extent(), (1 + 0.05) * here.extent()) << name << ", " << offset;
    }
  }
}

TYPED_TEST(Bounding_volume_contract, non_finite_coordinates_do_not_crash) {
  const auto good = volume_of<TypeParam>(solid_leaves()[0].soup);
  for (const auto& [name, soup] : all_leaves())
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity})
      for (const std::size_t place : {std::size_t{0}, std::size_t{4}, soup.coordinates.size() - 1}) {
        auto broken = soup;
        broken.coordinates[place] = bad;
        if (place == 4) std::ranges::fill(broken.coordinates, bad);
        const auto volume = volume_of<TypeParam>(broken);
        const auto parent = volume_of<TypeParam>(volume, good);
        static_cast<void>(near(volume, good, 0));
        static_cast<void>(near(good, parent, 1));
        static_cast<void>(parent.extent() + parent.volume() + parent.bounds().low[0]);
      }
}

}  // namespace
}  // namespace lodestone
