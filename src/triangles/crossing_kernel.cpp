// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/crossing_kernel.h"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "triangles/crossing_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/double_double-inl.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// One edge and its plane per lane.
using Edge_lanes = hn::CappedTag<double, most_edges>;
using Edges = hn::Vec<Edge_lanes>;
using Edge_mask = hn::Mask<Edge_lanes>;
using Number = Double_double<Edges>;
using Difference = std::array<Number, 3>;

HWY_INLINE Edges all(double x) { return hn::Set(Edge_lanes(), x); }

HWY_INLINE std::array<Edges, 3> load(const double (&vector)[3][most_edges], std::size_t lane) {
  const Edge_lanes d;
  return {hn::LoadU(d, vector[0] + lane), hn::LoadU(d, vector[1] + lane), hn::LoadU(d, vector[2] + lane)};
}

HWY_INLINE Difference operator-(const std::array<Edges, 3>& p, const std::array<Edges, 3>& q) {
  return {exact_difference(p[0], q[0]), exact_difference(p[1], q[1]), exact_difference(p[2], q[2])};
}

HWY_INLINE Difference cross(const Difference& u, const Difference& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

/// The largest absolute coordinate. Infinite if products of three numbers of this size could overflow or lose digits
/// that count.
HWY_INLINE Edges size(const Difference& v) {
  const Edges largest = hn::Max(hn::Max(hn::Abs(v[0].high), hn::Abs(v[1].high)), hn::Abs(v[2].high));
  const Edge_mask moderate = hn::And(hn::Gt(largest, all(0x1p-250)), hn::Lt(largest, all(0x1p250)));
  return hn::IfThenElse(moderate, largest, all(std::numeric_limits<double>::infinity()));
}

/// The plane of a triangle.
struct Plane {
  std::array<Edges, 3> corner;
  Difference normal;  ///< not of unit length; the error of each coordinate is below 2^-99 `size`
  Edges size;         ///< product of the sizes of the two edges that span the plane
};

/// normal . (p - corner), with a bound of its error.
struct Height {
  Number value;
  Edges error;
};

/// Let s be the size of the plane times that of p - corner. The error of each product is below (2^-99 + 2^-100) s. Each
/// of the two sums, of numbers below 6 s together, adds at most 2^-103 12 s. In all that is below 2^-96 s.
HWY_INLINE Height height(const Plane& plane, const std::array<Edges, 3>& p) {
  const Difference w = p - plane.corner;
  const Difference& n = plane.normal;
  return {n[0] * w[0] + n[1] * w[1] + n[2] * w[2], hn::Mul(all(0x1p-96), hn::Mul(plane.size, size(w)))};
}

/// Whether the nearest double to a number is its `high`, given a bound of the number's error.
HWY_INLINE Edge_mask is_rounded(const Number& x, Edges error) {
  // Twice the error also covers the rounding of these sums.
  const Edges twice = hn::Add(error, error);
  return hn::And(hn::Eq(hn::Add(x.high, hn::Add(x.low, twice)), x.high),
                 hn::Eq(hn::Add(x.high, hn::Sub(x.low, twice)), x.high));
}

void crossing_points_kernel(const Edges_and_planes& edges, Crossing_points& points) {
  const Edge_lanes d;
  for (std::size_t lane = 0; lane < edges.count; lane += hn::Lanes(d)) {
    const std::array corners{load(edges.plane[0], lane), load(edges.plane[1], lane), load(edges.plane[2], lane)};
    const Difference u = corners[1] - corners[0], v = corners[2] - corners[0];
    const Plane plane{corners[0], cross(u, v), hn::Mul(size(u), size(v))};
    const auto from = load(edges.from, lane), to = load(edges.to, lane);
    const Difference edge = to - from;

    // The heights have different signs, so `whole` is the sum of their sizes, and its error the sum of their errors.
    const Height first = height(plane, from), last = height(plane, to);
    const Number whole = first.value - last.value, share = first.value / whole;
    const Edges errors = hn::Mul(all(4), hn::Add(first.error, last.error));
    const Edges share_error = hn::Add(hn::Div(errors, hn::Abs(whole.high)), all(0x1p-98));
    Edge_mask proven = hn::Lt(share_error, all(0x1p-20));

    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Number coordinate = Number{from[axis], hn::Zero(d)} + share * edge[axis];
      const Edges length = hn::Abs(edge[axis].high);
      // Products of a tiny length may underflow. Without length the coordinate is that of `from`.
      const Edges underflow = hn::IfThenZeroElse(hn::Eq(length, hn::Zero(d)), all(0x1p-1060));
      const Edges error = hn::Add(underflow, hn::Add(hn::Mul(length, share_error),
                                                     hn::Mul(all(0x1p-100), hn::Add(hn::Abs(from[axis]), length))));
      // A coordinate that all corners of the triangle share is that of the point too, whatever its rounding.
      const Edge_mask shared =
          hn::And(hn::Eq(corners[0][axis], corners[1][axis]), hn::Eq(corners[0][axis], corners[2][axis]));
      proven = hn::And(proven, hn::Or(shared, is_rounded(coordinate, error)));
      const Edges nearest = hn::IfThenElse(shared, corners[0][axis], coordinate.high);
      hn::StoreU(hn::Add(nearest, hn::Zero(d)), d, points.coordinates[axis] + lane);  // never -0
    }
    double one_if_proven[most_edges];
    hn::StoreU(hn::IfThenElseZero(proven, all(1)), d, one_if_proven);
    for (std::size_t edge_lane = 0; edge_lane < hn::Lanes(d); ++edge_lane)
      points.proven[lane + edge_lane] = one_if_proven[edge_lane] != 0;
  }
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(crossing_points_kernel);

void crossing_points(const Edges_and_planes& edges, Crossing_points& points) {
  HWY_DYNAMIC_DISPATCH(crossing_points_kernel)(edges, points);
}

}  // namespace lodestone::kernel
#endif
