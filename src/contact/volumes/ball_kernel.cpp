// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/volumes/ball_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/volumes/ball_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "contact/position_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE void copy_vertex(const double* vertex, std::size_t place, Leaf_points& points) {
  points.x[place] = vertex[0];
  points.y[place] = vertex[1];
  points.z[place] = vertex[2];
}

#if HWY_MAX_BYTES >= 32
constexpr std::size_t vertices_at_once = 4;

/// Four vertices, none of which may be the last of the mesh: a number past z is read.
HWY_INLINE void copy_vertices(const double* coordinates, const std::uint32_t* vertices, std::size_t place,
                              Leaf_points& points) {
  const D d;
  const auto load = [&](std::size_t k) { return hn::LoadU(d, coordinates + 3 * std::size_t{vertices[place + k]}); };
  const auto p = load(0), q = load(1), r = load(2), s = load(3);
  const auto pq_even = hn::InterleaveLower(d, p, q), rs_even = hn::InterleaveLower(d, r, s);
  const auto pq_odd = hn::InterleaveUpper(d, p, q), rs_odd = hn::InterleaveUpper(d, r, s);
  hn::Store(hn::ConcatLowerLower(d, rs_even, pq_even), d, points.x + place);
  hn::Store(hn::ConcatLowerLower(d, rs_odd, pq_odd), d, points.y + place);
  hn::Store(hn::ConcatUpperUpper(d, rs_even, pq_even), d, points.z + place);
}
#else
constexpr std::size_t vertices_at_once = 1;

HWY_INLINE void copy_vertices(const double* coordinates, const std::uint32_t* vertices, std::size_t place,
                              Leaf_points& points) {
  copy_vertex(coordinates + 3 * std::size_t{vertices[place]}, place, points);
}
#endif

void gather_kernel(const double* coordinates, const std::uint32_t* vertices, std::size_t count, Leaf_points& points) {
  const std::size_t last = count - 1;
  std::size_t place = 0;
  for (; place + vertices_at_once <= last; place += vertices_at_once)
    copy_vertices(coordinates, vertices, place, points);
  for (; place < last; ++place) copy_vertex(coordinates + 3 * std::size_t{vertices[place]}, place, points);
  points.size = (count + Leaf_points::step - 1) / Leaf_points::step * Leaf_points::step;
  for (; place < points.size; ++place) copy_vertex(coordinates + 3 * std::size_t{vertices[last]}, place, points);
}

using Wide = hn::CappedTag<double, Leaf_points::step>;
constexpr std::size_t wide_lanes = hn::MaxLanes(Wide());

/// A squared distance and the place of its vertex in one number: its last bits give way to the place. So one maximum
/// finds both, and no two are equal.
template <class V>
HWY_INLINE V with_place(V squared_distance, hn::Vec<hn::RebindToUnsigned<Wide>> place) {
  const hn::RebindToUnsigned<Wide> bits;
  static_assert(Leaf_points::capacity <= 512);
  return hn::BitCast(Wide(),
                     hn::Or(hn::And(hn::BitCast(bits, squared_distance), hn::Set(bits, ~std::uint64_t{511})), place));
}

Farthest farthest_kernel(const Leaf_points& points, const double* centre) {
  const Wide d;
  const hn::RebindToUnsigned<Wide> bits;
  const auto cx = hn::Set(d, centre[0]), cy = hn::Set(d, centre[1]), cz = hn::Set(d, centre[2]);
  auto most = hn::Zero(d), most_with_place = hn::Zero(d);
  auto place = hn::Iota(bits, 0);
  for (std::size_t i = 0; i < points.size; i += wide_lanes) {
    const auto x = hn::Sub(hn::Load(d, points.x + i), cx);
    const auto y = hn::Sub(hn::Load(d, points.y + i), cy);
    const auto z = hn::Sub(hn::Load(d, points.z + i), cz);
    const auto squared = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
    most = hn::Max(most, squared);
    most_with_place = hn::Max(most_with_place, with_place(squared, place));
    place = hn::Add(place, hn::Set(bits, wide_lanes));
  }
  const double winner = hn::GetLane(hn::MaxOfLanes(d, most_with_place));
  std::uint64_t winner_bits;
  hwy::CopySameSize(&winner, &winner_bits);
  return {.place = winner_bits & 511, .squared_distance = hn::GetLane(hn::MaxOfLanes(d, most))};
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(gather_kernel);
HWY_EXPORT(farthest_kernel);

void gather(const double* coordinates, const std::uint32_t* vertices, std::size_t count, Leaf_points& points) {
  HWY_DYNAMIC_DISPATCH(gather_kernel)(coordinates, vertices, count, points);
}

Farthest farthest(const Leaf_points& points, const double* centre) {
  return HWY_DYNAMIC_DISPATCH(farthest_kernel)(points, centre);
}

}  // namespace lodestone::kernel
#endif
