// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/ball_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "volumes/ball_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/vector_types-inl.h"
#include "volumes/vertex_blocks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

static_assert(Leaf_points::step == block_vertices && Leaf_points::capacity % block_vertices == 0);

HWY_INLINE void store_block(const Vertex_block& block, std::size_t first, Leaf_points& points) {
  const Double_lanes d;
  for (std::size_t i = 0; i < block_vectors; ++i) {
    hn::Store(block.of[i].x, d, points.x + first + i * double_lanes);
    hn::Store(block.of[i].y, d, points.y + first + i * double_lanes);
    hn::Store(block.of[i].z, d, points.z + first + i * double_lanes);
  }
}

void gather_kernel(const Leaf_faces& faces, Leaf_points& points) {
  const Vertex_blocks blocks(faces);
  for (std::size_t first = 0; first < blocks.last_block(); first += block_vertices)
    store_block(blocks.load(first), first, points);
  store_block(blocks.load_last(), blocks.last_block(), points);
  points.count = blocks.last + 1;
  points.size = blocks.last_block() + block_vertices;
}

HWY_INLINE Vector3<Double_lanes> load_points(const Leaf_points& points, std::size_t first) {
  const Double_lanes d;
  return {hn::Load(d, points.x + first), hn::Load(d, points.y + first), hn::Load(d, points.z + first)};
}

/// A squared distance and the index of its vertex in one number: the index replaces the last bits. So one maximum finds
/// both, and no two are equal.
HWY_INLINE Doubles with_index(Doubles squared_distance, hn::Vec<hn::RebindToUnsigned<Double_lanes>> index) {
  const hn::RebindToUnsigned<Double_lanes> bits;
  static_assert(Leaf_points::capacity <= 512);
  return hn::BitCast(Double_lanes(),
                     hn::Or(hn::And(hn::BitCast(bits, squared_distance), hn::Set(bits, ~std::uint64_t{511})), index));
}

Farthest farthest_kernel(const Leaf_points& points, const double* centre) {
  const Double_lanes d;
  const hn::RebindToUnsigned<Double_lanes> bits;
  const auto from = in_all_lanes(d, centre);
  auto most = hn::Zero(d), most_with_index = hn::Zero(d);
  auto index = hn::Iota(bits, 0);
  for (std::size_t i = 0; i < points.size; i += double_lanes) {
    const auto v = load_points(points, i) - from;
    const auto squared = dot(v, v);
    most = hn::Max(most, squared);
    most_with_index = hn::Max(most_with_index, with_index(squared, index));
    index = hn::Add(index, hn::Set(bits, double_lanes));
  }
  const double winner = hn::GetLane(hn::MaxOfLanes(d, most_with_index));
  std::uint64_t winner_bits;
  hwy::CopySameSize(&winner, &winner_bits);
  return {.index = static_cast<std::size_t>(winner_bits & 511),
          .squared_distance = hn::GetLane(hn::MaxOfLanes(d, most))};
}

/// Sums terms over the vertices, as seen from a point and times a factor. Every instruction set adds the same eight
/// partial sums, each of every eighth vertex, so all give the same bits.
/// @param terms  `terms(x, y, z, out)` writes `count` terms
template <std::size_t count, class Terms>
HWY_INLINE void add_up(const Leaf_points& points, const double* origin, double factor, const Terms& terms,
                       double* results) {
  const Double_lanes d;
  const hn::RebindToSigned<Double_lanes> integers;
  const auto end = hn::Set(integers, static_cast<std::int64_t>(points.count));
  const auto from = in_all_lanes(d, origin);
  const auto scale = hn::Set(d, factor);
  alignas(64) double sums[count][Leaf_points::step];
  for (std::size_t first = 0; first < Leaf_points::step; first += double_lanes) {
    Doubles sum[count], term[count];
    for (auto& s : sum) s = hn::Zero(d);
    for (std::size_t i = first; i < points.size; i += Leaf_points::step) {
      const auto real = hn::RebindMask(d, hn::Lt(hn::Iota(integers, static_cast<std::int64_t>(i)), end));
      const auto v = load_points(points, i) - from;
      const auto x = hn::IfThenElseZero(real, hn::Mul(v.x, scale));
      const auto y = hn::IfThenElseZero(real, hn::Mul(v.y, scale));
      const auto z = hn::IfThenElseZero(real, hn::Mul(v.z, scale));
      terms(x, y, z, term);
      for (std::size_t k = 0; k < count; ++k) sum[k] = hn::Add(sum[k], term[k]);
    }
    for (std::size_t k = 0; k < count; ++k) hn::Store(sum[k], d, sums[k] + first);
  }
  for (std::size_t k = 0; k < count; ++k) {
    results[k] = 0;
    for (const double s : sums[k]) results[k] += s;
  }
}

Sum sum_kernel(const Leaf_points& points, const double* origin) {
  double sums[3];
  add_up<3>(
      points, origin, 1,
      [](auto x, auto y, auto z, auto* term) HWY_ATTR {
        term[0] = x;
        term[1] = y;
        term[2] = z;
      },
      sums);
  return {sums[0], sums[1], sums[2]};
}

Sphere_moments sphere_moments_kernel(const Leaf_points& points, const double* origin, double factor) {
  double m[10];
  add_up<10>(
      points, origin, factor,
      [](auto x, auto y, auto z, auto* term) HWY_ATTR {
        term[0] = hn::Mul(x, x);
        term[1] = hn::Mul(x, y);
        term[2] = hn::Mul(y, y);
        term[3] = hn::Mul(y, z);
        term[4] = hn::Mul(z, z);
        term[5] = hn::Mul(z, x);
        const auto r = hn::Add(hn::Add(term[0], term[2]), term[4]);
        term[6] = hn::Mul(r, x);
        term[7] = hn::Mul(r, y);
        term[8] = hn::Mul(r, z);
        term[9] = hn::Mul(r, r);
      },
      m);
  for (double& mean : m) mean /= static_cast<double>(points.count);
  return {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9]};
}

Directions directions_kernel(const Leaf_points& points, const double* centre, const double* axis,
                             double* squared_distances) {
  const Double_lanes d;
  const auto from = in_all_lanes(d, centre), direction = in_all_lanes(d, axis);
  auto least = hn::Set(d, hwy::HighestValue<double>()), most = hn::Zero(d), least_cosine = hn::Set(d, 1);
  for (std::size_t i = 0; i < points.size; i += double_lanes) {
    const auto v = load_points(points, i) - from;
    const auto squared = dot(v, v), along = dot(v, direction);
    least = hn::Min(least, squared);
    most = hn::Max(most, squared);
    least_cosine = hn::Min(least_cosine, hn::Div(along, hn::Sqrt(squared)));
    hn::Store(squared, d, squared_distances + i);
  }
  return {.least_squared_distance = hn::GetLane(hn::MinOfLanes(d, least)),
          .most_squared_distance = hn::GetLane(hn::MaxOfLanes(d, most)),
          .least_cosine = hn::GetLane(hn::MinOfLanes(d, least_cosine))};
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(gather_kernel);
HWY_EXPORT(farthest_kernel);
HWY_EXPORT(sum_kernel);
HWY_EXPORT(sphere_moments_kernel);
HWY_EXPORT(directions_kernel);

void gather(const Leaf_faces& faces, Leaf_points& points) { HWY_DYNAMIC_DISPATCH(gather_kernel)(faces, points); }

Farthest farthest(const Leaf_points& points, const double* centre) {
  return HWY_DYNAMIC_DISPATCH(farthest_kernel)(points, centre);
}

Sum sum(const Leaf_points& points, const double* origin) { return HWY_DYNAMIC_DISPATCH(sum_kernel)(points, origin); }

Sphere_moments sphere_moments(const Leaf_points& points, const double* origin, double factor) {
  return HWY_DYNAMIC_DISPATCH(sphere_moments_kernel)(points, origin, factor);
}

Directions directions(const Leaf_points& points, const double* centre, const double* axis, double* squared_distances) {
  return HWY_DYNAMIC_DISPATCH(directions_kernel)(points, centre, axis, squared_distances);
}

}  // namespace lodestone::kernel
#endif
