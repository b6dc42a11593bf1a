// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/contact_normal_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "triangles/contact_normal_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// One pair of triangles per lane.
using Pair_lanes = hn::CappedTag<double, most_normals>;
using Numbers = hn::Vec<Pair_lanes>;
using Vectors = Vector3<Pair_lanes>;
using Triangles = std::array<Vectors, 3>;

HWY_INLINE Numbers every(double x) { return hn::Set(Pair_lanes(), x); }

HWY_INLINE Triangles load_triangles(const double (&corners)[3][3][most_normals], std::size_t lane) {
  const Pair_lanes d;
  Triangles t;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const auto& [x, y, z] = corners[corner];
    t[corner] = {hn::LoadU(d, x + lane), hn::LoadU(d, y + lane), hn::LoadU(d, z + lane)};
  }
  return t;
}

HWY_INLINE Vectors divide(const Vectors& p, Numbers by) {
  return {hn::Div(p.x, by), hn::Div(p.y, by), hn::Div(p.z, by)};
}

HWY_INLINE Vectors select(hn::Mask<Pair_lanes> mask, const Vectors& yes, const Vectors& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y), hn::IfThenElse(mask, yes.z, no.z)};
}

HWY_INLINE Numbers largest_coordinate(const Vectors& v) {
  const Vectors sizes = absolute(v);
  return greatest(sizes.x, sizes.y, sizes.z);
}

struct Unit_normals {
  Vectors normal;
  hn::Mask<Pair_lanes> proven;  ///< the triangle is not so thin that the direction of the normal is in doubt
};

HWY_INLINE Unit_normals unit_normals(const Triangles& t) {
  const Vectors first = t[1] - t[0], second = t[2] - t[1];
  const Vectors normal = cross(first, second);
  const Numbers squared = dot(normal, normal), bound = hn::Mul(dot(first, first), dot(second, second));
  // Each coordinate of the product has an error below 2^-51 |first||second|.
  constexpr double thin = 0x1p-20;
  const auto proven = hn::And(hn::Gt(squared, hn::Mul(every(thin * thin), bound)), hn::Gt(squared, every(1e-280)));
  return {divide(normal, hn::Sqrt(squared)), proven};
}

void contact_normals_kernel(const Triangle_pairs& faces, Normals_and_depths& result) {
  const Pair_lanes d;
  for (std::size_t lane = 0; lane < faces.count; lane += hn::Lanes(d)) {
    const Triangles a = load_triangles(faces.a, lane), b = load_triangles(faces.b, lane);
    const auto [normal_a, proven_a] = unit_normals(a);
    const auto [normal_b, proven_b] = unit_normals(b);
    const Vectors outwards = normal_b - normal_a;
    const Numbers squared = dot(outwards, outwards);
    const auto differ = hn::Gt(squared, every(1e-16));
    const Vectors normal = select(differ, divide(outwards, hn::Sqrt(squared)), normal_b);

    Numbers depth = hn::Zero(d), size = hn::Zero(d);
    for (const auto& corner_b : b)
      for (const auto& corner_a : a) {
        const Vectors between = corner_b - corner_a;
        depth = hn::Max(depth, dot(normal, between));
        size = hn::Max(size, largest_coordinate(between));
      }
    // Products of four numbers of this size neither overflow nor lose digits that count.
    const auto moderate = hn::And(hn::Gt(size, every(0x1p-200)), hn::Lt(size, every(0x1p200)));

    auto& [x, y, z] = result.normal;
    hn::StoreU(normal.x, d, x + lane);
    hn::StoreU(normal.y, d, y + lane);
    hn::StoreU(normal.z, d, z + lane);
    hn::StoreU(hn::Add(depth, hn::Zero(d)), d, result.depth + lane);  // never -0
    double one_if_proven[most_normals];
    hn::StoreU(hn::IfThenElseZero(hn::And(moderate, hn::And(proven_a, proven_b)), every(1)), d, one_if_proven);
    for (std::size_t pair = 0; pair < hn::Lanes(d); ++pair) result.proven[lane + pair] = one_if_proven[pair] != 0;
  }
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(contact_normals_kernel);

void contact_normals(const Triangle_pairs& faces, Normals_and_depths& result) {
  HWY_DYNAMIC_DISPATCH(contact_normals_kernel)(faces, result);
}

}  // namespace lodestone::kernel
#endif
