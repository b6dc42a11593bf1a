// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/crossing_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "triangles/crossing_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "triangles/plane_height-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Whether the nearest double to a number is its `high`, given a bound of the number's error.
HWY_INLINE Plane_mask is_rounded(const Number& x, Planes error) {
  // Twice the error also covers the rounding of these sums.
  const Planes twice = hn::Add(error, error);
  return hn::And(hn::Eq(hn::Add(x.high, hn::Add(x.low, twice)), x.high),
                 hn::Eq(hn::Add(x.high, hn::Sub(x.low, twice)), x.high));
}

void crossing_points_kernel(const Edges_and_planes& edges, Crossing_points& points) {
  const Plane_lanes d;
  for (std::size_t lane = 0; lane < edges.count; lane += hn::Lanes(d)) {
    const std::array corners{load(edges.plane[0], lane), load(edges.plane[1], lane), load(edges.plane[2], lane)};
    const Plane plane = plane_through(corners[0], corners[1], corners[2]);
    const auto from = load(edges.from, lane), to = load(edges.to, lane);
    const Difference edge = to - from;

    // The heights have different signs, so `whole` is the sum of their sizes, and its error the sum of their errors.
    const Height first = height(plane, from), last = height(plane, to);
    const Number whole = first.value - last.value, share = first.value / whole;
    const Planes errors = hn::Mul(all(4), hn::Add(first.error, last.error));
    const Planes share_error = hn::Add(hn::Div(errors, hn::Abs(whole.high)), all(0x1p-98));
    Plane_mask proven = hn::Lt(share_error, all(0x1p-20));

    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Number coordinate = Number{from[axis], hn::Zero(d)} + share * edge[axis];
      const Planes length = hn::Abs(edge[axis].high);
      // Products of a tiny length may underflow. Without length the coordinate is that of `from`.
      const Planes underflow = hn::IfThenZeroElse(hn::Eq(length, hn::Zero(d)), all(0x1p-1060));
      const Planes error = hn::Add(underflow, hn::Add(hn::Mul(length, share_error),
                                                      hn::Mul(all(0x1p-100), hn::Add(hn::Abs(from[axis]), length))));
      // A coordinate that all corners of the triangle share is that of the point too, whatever its rounding.
      const Plane_mask shared =
          hn::And(hn::Eq(corners[0][axis], corners[1][axis]), hn::Eq(corners[0][axis], corners[2][axis]));
      proven = hn::And(proven, hn::Or(shared, is_rounded(coordinate, error)));
      const Planes nearest = hn::IfThenElse(shared, corners[0][axis], coordinate.high);
      hn::StoreU(hn::Add(nearest, hn::Zero(d)), d, points.coordinates[axis] + lane);  // never -0
    }
    double one_if_proven[most_planes];
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
