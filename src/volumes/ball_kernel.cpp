// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/ball_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "volumes/ball_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/position_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE void copy_vertex(const double* vertex, std::size_t index, Leaf_points& points) {
  points.x[index] = vertex[0];
  points.y[index] = vertex[1];
  points.z[index] = vertex[2];
}

#if HWY_MAX_BYTES >= 32
constexpr std::size_t vertices_at_once = 4;

/// Copies and transposes four vertices. None may be the last of the mesh, since the load reads one number past z.
HWY_INLINE void copy_vertices(const double* coordinates, const std::uint32_t* vertices, std::size_t index,
                              Leaf_points& points) {
  const D d;
  const auto load = [&](std::size_t k)
                        HWY_ATTR { return hn::LoadU(d, coordinates + 3 * std::size_t{vertices[index + k]}); };
  const auto p = load(0), q = load(1), r = load(2), s = load(3);
  const auto pq_even = hn::InterleaveLower(d, p, q), rs_even = hn::InterleaveLower(d, r, s);
  const auto pq_odd = hn::InterleaveUpper(d, p, q), rs_odd = hn::InterleaveUpper(d, r, s);
  hn::Store(hn::ConcatLowerLower(d, rs_even, pq_even), d, points.x + index);
  hn::Store(hn::ConcatLowerLower(d, rs_odd, pq_odd), d, points.y + index);
  hn::Store(hn::ConcatUpperUpper(d, rs_even, pq_even), d, points.z + index);
}
#else
constexpr std::size_t vertices_at_once = 1;

HWY_INLINE void copy_vertices(const double* coordinates, const std::uint32_t* vertices, std::size_t index,
                              Leaf_points& points) {
  copy_vertex(coordinates + 3 * std::size_t{vertices[index]}, index, points);
}
#endif

void gather_kernel(const double* coordinates, const std::uint32_t* vertices, std::size_t count, Leaf_points& points) {
  const std::size_t last = count - 1;
  std::size_t index = 0;
  for (; index + vertices_at_once <= last; index += vertices_at_once)
    copy_vertices(coordinates, vertices, index, points);
  for (; index < last; ++index) copy_vertex(coordinates + 3 * std::size_t{vertices[index]}, index, points);
  points.count = count;
  points.size = (count + Leaf_points::step - 1) / Leaf_points::step * Leaf_points::step;
  for (; index < points.size; ++index) copy_vertex(coordinates + 3 * std::size_t{vertices[last]}, index, points);
}

using Wide = hn::CappedTag<double, Leaf_points::step>;
constexpr std::size_t wide_lanes = hn::MaxLanes(Wide());

/// Packs a squared distance and the index of its vertex into one number: the index replaces the last nine bits. One
/// maximum then finds both, and no two numbers are equal.
template <class V>
HWY_INLINE V with_index(V squared_distance, hn::Vec<hn::RebindToUnsigned<Wide>> index) {
  const hn::RebindToUnsigned<Wide> bits;
  static_assert(Leaf_points::capacity <= 512);
  return hn::BitCast(Wide(),
                     hn::Or(hn::And(hn::BitCast(bits, squared_distance), hn::Set(bits, ~std::uint64_t{511})), index));
}

Farthest farthest_kernel(const Leaf_points& points, const double* centre) {
  const Wide d;
  const hn::RebindToUnsigned<Wide> bits;
  const auto cx = hn::Set(d, centre[0]), cy = hn::Set(d, centre[1]), cz = hn::Set(d, centre[2]);
  auto most = hn::Zero(d), most_with_index = hn::Zero(d);
  auto index = hn::Iota(bits, 0);
  for (std::size_t i = 0; i < points.size; i += wide_lanes) {
    const auto x = hn::Sub(hn::Load(d, points.x + i), cx);
    const auto y = hn::Sub(hn::Load(d, points.y + i), cy);
    const auto z = hn::Sub(hn::Load(d, points.z + i), cz);
    const auto squared = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
    most = hn::Max(most, squared);
    most_with_index = hn::Max(most_with_index, with_index(squared, index));
    index = hn::Add(index, hn::Set(bits, wide_lanes));
  }
  const double winner = hn::GetLane(hn::MaxOfLanes(d, most_with_index));
  std::uint64_t winner_bits;
  hwy::CopySameSize(&winner, &winner_bits);
  return {.index = winner_bits & 511, .squared_distance = hn::GetLane(hn::MaxOfLanes(d, most))};
}

/// Sums the terms of `terms(x, y, z, out)` over all vertices; (x, y, z) is the vertex minus `origin`, times `factor`.
/// Always keeps eight partial sums, each of every eighth vertex, so that all instruction sets give the same bits.
template <std::size_t count, class Terms>
HWY_INLINE void add_up(const Leaf_points& points, const double* origin, double factor, const Terms& terms,
                       double* results) {
  const Wide d;
  const hn::RebindToSigned<Wide> numbers;
  const auto end = hn::Set(numbers, static_cast<std::int64_t>(points.count));
  const auto ox = hn::Set(d, origin[0]), oy = hn::Set(d, origin[1]), oz = hn::Set(d, origin[2]);
  const auto scale = hn::Set(d, factor);
  alignas(64) double sums[count][Leaf_points::step];
  for (std::size_t first = 0; first < Leaf_points::step; first += wide_lanes) {
    hn::Vec<Wide> sum[count], term[count];
    for (auto& s : sum) s = hn::Zero(d);
    for (std::size_t i = first; i < points.size; i += Leaf_points::step) {
      const auto there = hn::RebindMask(d, hn::Lt(hn::Iota(numbers, static_cast<std::int64_t>(i)), end));
      const auto x = hn::IfThenElseZero(there, hn::Mul(hn::Sub(hn::Load(d, points.x + i), ox), scale));
      const auto y = hn::IfThenElseZero(there, hn::Mul(hn::Sub(hn::Load(d, points.y + i), oy), scale));
      const auto z = hn::IfThenElseZero(there, hn::Mul(hn::Sub(hn::Load(d, points.z + i), oz), scale));
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
  const Wide d;
  const auto cx = hn::Set(d, centre[0]), cy = hn::Set(d, centre[1]), cz = hn::Set(d, centre[2]);
  const auto ax = hn::Set(d, axis[0]), ay = hn::Set(d, axis[1]), az = hn::Set(d, axis[2]);
  auto least = hn::Set(d, hwy::HighestValue<double>()), most = hn::Zero(d), least_cosine = hn::Set(d, 1);
  for (std::size_t i = 0; i < points.size; i += wide_lanes) {
    const auto x = hn::Sub(hn::Load(d, points.x + i), cx);
    const auto y = hn::Sub(hn::Load(d, points.y + i), cy);
    const auto z = hn::Sub(hn::Load(d, points.z + i), cz);
    const auto squared = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
    const auto along = hn::Add(hn::Add(hn::Mul(x, ax), hn::Mul(y, ay)), hn::Mul(z, az));
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

void gather(const double* coordinates, const std::uint32_t* vertices, std::size_t count, Leaf_points& points) {
  HWY_DYNAMIC_DISPATCH(gather_kernel)(coordinates, vertices, count, points);
}

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
