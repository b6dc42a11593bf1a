// SPDX-License-Identifier: GPL-3.0-or-later
#include "queries/point_leaf_kernel.h"

#include <algorithm>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "queries/point_leaf_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "queries/leaf_codes-inl.h"
#include "simd/positions-inl.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Differences = Vector3<Double_lanes>;

HWY_INLINE Doubles number(double x) { return hn::Set(Double_lanes(), x); }

/// The vertices of a leaf, scaled, as seen from the point. Each coordinate is rounded once.
class Seen_vertices {
 public:
  HWY_INLINE Seen_vertices(const Leaf_faces& leaf, const Point_input& point) : count_(leaf.vertices.size()) {
    const Double_lanes d;
    Doubles nearest = number(std::numeric_limits<double>::infinity()), reach = hn::Zero(d);
    for (std::size_t k = 0; k < count_; k += double_lanes) {
      see(leaf, point, k);
      const Differences at = rows([&](std::size_t lane) HWY_ATTR { return k + lane; });
      hn::StoreU(at.x, d, at_[0] + k);
      hn::StoreU(at.y, d, at_[1] + k);
      hn::StoreU(at.z, d, at_[2] + k);
      const auto of_leaf = hn::FirstN(d, count_ - k);
      nearest = hn::IfThenElse(of_leaf, hn::Min(nearest, dot(at, at)), nearest);
      const Differences size = absolute(at);
      reach = hn::Max(reach, hn::IfThenElseZero(of_leaf, greatest(size.x, size.y, size.z)));
    }
    nearest_ = hn::GetLane(hn::MinOfLanes(d, nearest));
    reach_ = hn::GetLane(hn::MaxOfLanes(d, reach));
  }

  /// Some vertices, one per lane.
  /// @param vertex  called with a lane: a place in the list of the leaf's vertices
  template <class Vertex>
  HWY_INLINE Differences rows(const Vertex& vertex) const {
    return transpose([&](std::size_t lane, std::size_t i)
                         HWY_ATTR { return hn::LoadU(Position_lanes(), rows_[vertex(lane)] + i * position_lanes); });
  }

  /// The squared distance of the nearest.
  double nearest() const { return nearest_; }
  /// The largest difference along any axis.
  double reach() const { return reach_; }
  /// Writes a bit per side of a cube around the point, set where a vertex is beyond it.
  /// @param half_side  of the cube
  HWY_INLINE void code(double half_side, std::uint64_t* codes) const {
    const Double_lanes d;
    for (std::size_t k = 0; k < count_; k += double_lanes) {
      Codes code = hn::Zero(Code_lanes());
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Doubles at = hn::LoadU(d, at_[axis] + k);
        add_bit(code, axis, hn::Gt(at, number(half_side)));
        add_bit(code, 3 + axis, hn::Lt(at, number(-half_side)));
      }
      hn::StoreU(code, Code_lanes(), codes + k);
    }
  }

 private:
  /// Writes some rows.
  HWY_INLINE void see(const Leaf_faces& leaf, const Point_input& point, std::size_t first) {
    const Position_lanes d;
    const Position_vector scale = hn::Set(d, point.scale);
    for (std::size_t k = first; k < first + double_lanes; ++k) {
      const double* const position = leaf.coordinates.data() + 3 * std::size_t{leaf.vertices.data()[k]};
      for (std::size_t i = 0; i < position_vectors; ++i) {
        const Position_vector from = hn::LoadU(d, point.scaled + i * position_lanes);
        hn::StoreU(hn::Sub(hn::Mul(load_position(position, i), scale), from), d, rows_[k] + i * position_lanes);
      }
    }
  }

  std::size_t count_;
  double nearest_, reach_;
  double at_[3][most_codes];
  alignas(64) double rows_[most_codes][4];  ///< x, y, z and padding
};

/// Weights of the second and the third corner.
struct Weights {
  Doubles b, c;
};

/// Those of the points nearest to the origin, by the regions of \cite ericson2005, as in
/// `triangles/point_distance.cpp`. Wherever rounding leads, they are those of a point of the triangle.
HWY_INLINE Weights nearest_point(const Differences& a, const Differences& b, const Differences& c,
                                 const Differences& ab, const Differences& ac) {
  const Double_lanes d;
  const Doubles zero = hn::Zero(d), one = number(1);
  const Doubles d1 = hn::Neg(dot(ab, a)), d2 = hn::Neg(dot(ac, a)), d3 = hn::Neg(dot(ab, b)), d4 = hn::Neg(dot(ac, b)),
                d5 = hn::Neg(dot(ab, c)), d6 = hn::Neg(dot(ac, c));
  const auto cross = [](Doubles p, Doubles q, Doubles r, Doubles s)
                         HWY_ATTR { return hn::Sub(hn::Mul(p, q), hn::Mul(r, s)); };
  const Doubles of_c = cross(d1, d4, d3, d2), of_b = cross(d5, d2, d1, d6), of_a = cross(d3, d6, d5, d4);
  // From the last region to the first.
  Doubles share_b = of_b, share_c = of_c, all = hn::Add(hn::Add(of_a, of_b), of_c);
  const auto take = [&](Double_mask region, Doubles b_there, Doubles c_there, Doubles all_there) HWY_ATTR {
    share_b = hn::IfThenElse(region, b_there, share_b);
    share_c = hn::IfThenElse(region, c_there, share_c);
    all = hn::IfThenElse(region, all_there, all);
  };
  const auto edge = [&](Doubles area, Doubles from_first, Doubles from_last) HWY_ATTR {
    return hn::And(hn::Le(area, zero), hn::And(hn::Ge(from_first, zero), hn::Ge(from_last, zero)));
  };
  const Doubles along_bc = hn::Sub(d4, d3), back_along_bc = hn::Sub(d5, d6);
  take(edge(of_a, along_bc, back_along_bc), back_along_bc, along_bc, hn::Add(along_bc, back_along_bc));
  take(edge(of_b, d2, hn::Neg(d6)), zero, d2, hn::Sub(d2, d6));
  take(edge(of_c, d1, hn::Neg(d3)), d1, zero, hn::Sub(d1, d3));
  take(hn::And(hn::Ge(d6, zero), hn::Le(d5, d6)), zero, one, one);
  take(hn::And(hn::Ge(d3, zero), hn::Le(d4, d3)), one, zero, one);
  take(hn::And(hn::Le(d1, zero), hn::Le(d2, zero)), zero, zero, one);
  const Doubles part_b = hn::Div(share_b, all), part_c = hn::Div(share_c, all);
  const Doubles weight_b = hn::Min(hn::IfThenElseZero(hn::Gt(part_b, zero), part_b), one);
  return {weight_b, hn::Min(hn::IfThenElseZero(hn::Gt(part_c, zero), part_c), hn::Sub(one, weight_b))};
}

/// Bounds on squared distances.
struct Distances {
  Doubles low, high;
};

/// How far triangles are from the origin: the bounds of `estimate_distance`, which hold for any point of the triangle
/// in place of the nearest. Here edges are differences of rounded corners. That makes 16 roundings of the greatest
/// distance of a corner, as there.
/// @param farthest  no corner is farther
HWY_INLINE Distances bound(const Differences& a, const Differences& b, const Differences& c, double farthest) {
  const Double_lanes d;
  const Differences ab = b - a, ac = c - a;
  const Weights weights = nearest_point(a, b, c, ab, ac);
  const auto mix = [&](Doubles from, Doubles along_ab, Doubles along_ac) HWY_ATTR {
    return hn::Add(hn::Add(from, hn::Mul(weights.b, along_ab)), hn::Mul(weights.c, along_ac));
  };
  const Differences gap{mix(a.x, ab.x, ac.x), mix(a.y, ab.y, ac.y), mix(a.z, ab.z, ac.z)};
  const Doubles squared = dot(gap, gap), underflow = number(distance_underflow);
  const Doubles size = hn::Mul(hn::Sqrt(squared), number(farthest));
  const Doubles of_size = hn::Add(hn::Mul(number(0x1p-46), size), number(0x1p-90 * farthest * farthest));
  const Doubles least_along = least(dot(gap, a), dot(gap, b), dot(gap, c));
  const Doubles proven = hn::Sub(hn::Sub(least_along, hn::Mul(number(0x1p-48), size)), underflow);
  const Doubles low = hn::Mul(hn::Mul(proven, hn::Div(proven, squared)), number(1 - 0x1p-48));
  return {hn::IfThenElseZero(hn::Gt(proven, hn::Zero(d)), low), hn::Add(hn::Add(squared, of_size), underflow)};
}

/// The least squared distance that triangles can have, by the lengths of their edges. A point with the weights w_i in
/// the corners c_i has the squared distance sum w_i |c_i|^2 - sum_{i<j} w_i w_j |c_i - c_j|^2, and the sum of w_i w_j
/// is 1/3 at most.
HWY_INLINE Doubles bound_by_edges(const Differences& a, const Differences& b, const Differences& c) {
  constexpr double third = 0x1.5555555555556p-2;  // rounded up
  const auto squared = [](const Differences& v) HWY_ATTR { return dot(v, v); };
  const Doubles of_a = squared(a), of_b = squared(b), of_c = squared(c);
  const Doubles longest = greatest(squared(a - b), squared(b - c), squared(c - a));
  const Doubles error =
      hn::Add(hn::Mul(number(distance_roundings), greatest(of_a, of_b, of_c)), number(distance_underflow));
  return hn::Sub(hn::Sub(least(of_a, of_b, of_c), hn::Mul(longest, number(third))), error);
}

/// Faces of a leaf, and a point.
class Leaf_search {
 public:
  /// @param candidates  room for `most_leaf_faces`
  HWY_INLINE Leaf_search(const Leaf_faces& leaf, const Point_input& point, double most, std::uint8_t* candidates)
      : leaf_(leaf), vertices_(leaf, point), most_(most), candidates_(candidates) {}

  HWY_INLINE void run() {
    most_ = std::min(most_, vertices_.nearest() * (1 + distance_roundings) + distance_underflow);
    // A face that is beyond one side of the cube around the ball of that radius is not in the ball.
    const double half_side = std::sqrt(most_) * (1 + 0x1p-50);
    if (vertices_.reach() > half_side)
      list_faces_at_cube(half_side);
    else
      list_all_faces();
    keep([](const Differences& a, const Differences& b, const Differences& c, Doubles& /*nearest*/)
             HWY_ATTR { return bound_by_edges(a, b, c); });
    if (count_ < 2) return;
    const double farthest = 1.7321 * vertices_.reach();  // more than the root of 3
    keep([farthest](const Differences& a, const Differences& b, const Differences& c, Doubles& nearest) HWY_ATTR {
      const Distances distances = bound(a, b, c, farthest);
      nearest = hn::Min(nearest, distances.high);
      return distances.low;
    });
  }

  double most() const { return most_; }
  std::size_t count() const { return count_; }

 private:
  HWY_INLINE void list_all_faces() {
    count_ = leaf_.corners.size();
    for (std::size_t face = 0; face < count_; ++face) candidates_[face] = static_cast<std::uint8_t>(face);
  }

  HWY_INLINE void list_faces_at_cube(double half_side) {
    std::uint64_t codes[most_codes];
    vertices_.code(half_side, codes);
    count_ = list_faces(leaf_, codes, candidates_);
  }

  /// Keeps the candidates that may be as near as `most_`.
  /// @param low  lower bounds on their squared distances; may lower upper bounds on that of the nearest
  template <class Low>
  HWY_INLINE void keep(const Low& low) {
    const Double_lanes d;
    double bounds[most_leaf_faces];
    Doubles nearest = number(most_);
    for (std::size_t i = 0; i < count_; i += double_lanes) {
      const auto corner = [&](std::size_t c) HWY_ATTR {
        return vertices_.rows([&](std::size_t lane) HWY_ATTR {
          return std::size_t{leaf_.corners[candidates_[std::min(i + lane, count_ - 1)]][c]};
        });
      };
      hn::StoreU(low(corner(0), corner(1), corner(2), nearest), d, bounds + i);
    }
    most_ = hn::GetLane(hn::MinOfLanes(d, nearest));
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      candidates_[kept] = candidates_[i];
      kept += bounds[i] > most_ ? 0 : 1;  // keeps what is not a number
    }
    count_ = kept;
  }

  const Leaf_faces& leaf_;
  const Seen_vertices vertices_;
  double most_;
  std::uint8_t* candidates_;
  std::size_t count_ = 0;
};

std::size_t list_near_faces_kernel(const Leaf_faces& leaf, const Point_input& point, double& most,
                                   std::uint8_t* candidates) {
  prefetch(leaf.corners);
  Leaf_search search(leaf, point, most, candidates);
  search.run();
  most = search.most();
  return search.count();
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(list_near_faces_kernel);

std::size_t list_near_faces(const Leaf_faces& leaf, const Point_input& point, double& most, std::uint8_t* candidates) {
  return HWY_DYNAMIC_DISPATCH(list_near_faces_kernel)(leaf, point, most, candidates);
}

}  // namespace lodestone::kernel
#endif
