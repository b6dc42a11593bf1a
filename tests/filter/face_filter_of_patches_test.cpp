// SPDX-License-Identifier: GPL-3.0-or-later
// Leaves that are nearly flat: faces that only touch the slab around the other leaf, or just miss it, are kept.
#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "filter/filter_checks.h"
#include "lodestone/triangles/triangle_distance.h"

namespace lodestone {
namespace {

using Eigen::Vector3d;

/// The faces of a patch, nearly in one plane, and pins: faces that come down to it from one side.
class Patch_and_pins {
 public:
  explicit Patch_and_pins(std::uint64_t seed) : random_(seed) {
    turn_ = Eigen::Quaterniond(uniform(), uniform(), uniform(), uniform() + 2).normalized();
    const double roughness = random_() % 3 == 0 ? 0 : std::pow(10, 8 * uniform() - 9);
    for (std::uint32_t f = 0; f < faces; ++f) {
      const Vector3d middle(uniform(), uniform(), 0);
      for (auto& corner : patch_[f])
        corner = turn_ * (middle + 0.3 * Vector3d(uniform(), uniform(), 0) + roughness * Vector3d(0, 0, uniform()));
    }
  }

  static constexpr std::uint32_t faces = 64;

  void set_patch(Single_leaf& leaf, const Placement& placement) const {
    for (std::uint32_t f = 0; f < faces; ++f) leaf.set(f, placed(triangle(patch_[f]), placement));
  }
  /// The pins end at a height above the patch, up to rounding or a little more.
  void set_pins(Single_leaf& leaf, double height, const Placement& placement) {
    for (std::uint32_t f = 0; f < faces; ++f) {
      const auto& [p, q, r] = patch_[random_() % faces];
      const double u = random_() % 3 == 0 ? 0 : 0.5 + 0.5 * uniform(),
                   v = random_() % 3 == 0 ? 0 : 0.5 + 0.5 * uniform();
      const double small = random_() % 2 == 0 ? 0 : uniform() * std::pow(10, -17 * std::abs(uniform()));
      const Vector3d on_patch = p + (1 - v) * u * (q - p) + v * (r - p);
      const Vector3d end = on_patch + (height + small) * (turn_ * Vector3d(0, 0, 1));
      const auto up = [&] {
        return Vector3d(end +
                        turn_ * (0.2 * Vector3d(uniform(), uniform(), 0) + Vector3d(0, 0, 0.6 + 0.5 * uniform())));
      };
      leaf.set(f, placed(triangle({end, up(), up()}), placement));
    }
  }

 private:
  using Corners_of_face = std::array<Vector3d, 3>;

  double uniform() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
  static Triangle triangle(const Corners_of_face& t) {
    const auto point = [](const Vector3d& p) { return Point(p.x(), p.y(), p.z()); };
    return {point(t[0]), point(t[1]), point(t[2])};
  }

  std::mt19937_64 random_;
  Eigen::Quaterniond turn_;
  std::array<Corners_of_face, faces> patch_;
};

/// Checks that no pair is discarded for which `near(a, b)` holds.
/// @return number of pairs for which it holds
template <class Near>
std::size_t expect_near_faces_kept(const Single_leaf& a, const Single_leaf& b, double margin, const Near& near) {
  const Face_pairs kept = candidate_pairs(a.view(), b.view(), margin);
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < a.size(); ++i)
    for (std::uint32_t j = 0; j < b.size(); ++j) {
      const bool is_near = near(a.triangle(i), b.triangle(j));
      count += is_near ? 1 : 0;
      EXPECT_TRUE(!is_near || std::ranges::binary_search(kept, Face_pair{i, j})) << i << ' ' << j;
    }
  return count;
}

TEST(Face_filter_of_patches, keeps_faces_that_touch) {
  Single_leaf patch(Patch_and_pins::faces), pins(Patch_and_pins::faces);
  std::size_t meet = 0, asked = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (const Placement& placement : placements) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", scale " << placement.scale << ", offset "
                                      << placement.offset);
      Patch_and_pins both(seed);
      both.set_patch(patch, placement);
      both.set_pins(pins, 0, placement);
      patch.refit(), pins.refit();
      meet += expect_near_faces_kept(patch, pins, 0, triangles_intersect);
      expect_near_faces_kept(pins, patch, 0, triangles_intersect);
      asked += patch.size() * pins.size();
      if (HasFailure()) return;
    }
  EXPECT_GT(meet, asked / 200);
  EXPECT_LT(meet, asked / 4);
}

TEST(Face_filter_of_patches, keeps_faces_nearer_than_the_margin) {
  Single_leaf patch(Patch_and_pins::faces), pins(Patch_and_pins::faces);
  std::size_t near = 0, asked = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed)
    for (const Placement& placement : {Placement{1, 0}, {1, 0x1p20}, {0x1p-300, 0}, {0x1p300, 0}})
      for (const double height : {1e-6, 0.01, 0.3}) {
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", scale " << placement.scale << ", height " << height);
        Patch_and_pins both(seed);
        both.set_patch(patch, placement);
        both.set_pins(pins, height, placement);
        patch.refit(), pins.refit();
        const double margin = placement.scale * height * (seed % 2 == 0 ? 1 : 1 + 1e-9);
        const auto nearer = [margin](const Triangle& s, const Triangle& t) {
          return triangles_nearer_than(s, t, margin);
        };
        near += expect_near_faces_kept(patch, pins, margin, nearer);
        expect_near_faces_kept(pins, patch, margin, nearer);
        asked += patch.size() * pins.size();
        if (HasFailure()) return;
      }
  EXPECT_GT(near, asked / 200);
  EXPECT_LT(near, asked / 2);
}

/// Corners are rounded relative to the size of their leaf, so small faces lose most of their digits.
TEST(Face_filter_of_patches, keeps_faces_nearer_than_the_margin_that_are_tiny_beside_others) {
  constexpr std::uint32_t last = Patch_and_pins::faces;
  Single_leaf patch(last + 1), pins(last + 1);
  patch.set(last, {Point(-1, -1, -1), Point(1, 1, 1), Point(1, -1, 0.5)});
  pins.set(last, {Point(1, 1, -1), Point(-1, -1, 1), Point(-1, 1, 0.25)});
  std::size_t near = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed)
    for (int exponent = -4; exponent >= -24; exponent -= 4)
      for (const double height : {1e-3, 0.3}) {
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", scale 2^" << exponent << ", height " << height);
        const Placement placement{std::ldexp(1, exponent), 0.07 * static_cast<double>(seed)};
        Patch_and_pins both(seed);
        both.set_patch(patch, placement);
        both.set_pins(pins, height, placement);
        patch.refit(), pins.refit();
        const double margin = placement.scale * height * (1 + 1e-9);
        near += expect_near_faces_kept(patch, pins, margin, [margin](const Triangle& s, const Triangle& t) {
          return triangles_nearer_than(s, t, margin);
        });
        if (HasFailure()) return;
      }
  EXPECT_GT(near, 5000U);
}

}  // namespace
}  // namespace lodestone
