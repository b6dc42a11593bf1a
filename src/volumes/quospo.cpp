// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/volumes/quospo.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "lodestone/volumes/bounding_volume.h"
#include "volumes/infinity.h"
#include "volumes/principal_axes.h"
#include "volumes/slab_kernel.h"
#include "volumes/slab_polytope.h"

namespace lodestone {

static_assert(Bounding_volume<Quospo>);

namespace {

using Directions = std::array<std::array<double, 3>, 3>;

/// The smallest of the 24 rotations from the coordinate axes to three perpendicular lines.
/// @param axes  directions of the lines as rows, right-handed
Eigen::Matrix3d smallest_turn(const Eigen::Matrix3d& axes) {
  constexpr int orders[6][3]{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  Eigen::Matrix3d best = axes;
  double best_trace = -infinity;
  for (int order = 0; order < 6; ++order) {
    Eigen::Matrix3d turn;
    for (int i = 0; i < 3; ++i) turn.row(i) = axes.row(orders[order][i]);
    // Each line gets the direction nearer to its axis. If the result is a mirror image, the line whose choice was
    // closest is reversed.
    bool mirrored = order >= 3;
    for (int i = 0; i < 3; ++i)
      if (turn(i, i) < 0) turn.row(i) = -turn.row(i), mirrored = !mirrored;
    int least = 0;
    turn.diagonal().minCoeff(&least);
    if (mirrored) turn.row(least) = -turn.row(least);
    if (turn.trace() > best_trace) best = turn, best_trace = turn.trace();
  }
  return best;
}

/// The rotation nearest to some axes: the smallest rotation to them, as a quaternion with real part w, rounded to
/// integers.
Quantised_turn nearest_turn(const Eigen::Matrix3d& axes) {
  const Eigen::Matrix3d turn = smallest_turn(axes);
  Quantised_turn result;
  const auto rounded = [&](double difference) {
    return static_cast<std::int16_t>(std::lround(std::clamp(result.w * difference / (1 + turn.trace()), -7.0, 7.0)));
  };
  result.x = rounded(turn(2, 1) - turn(1, 2));
  result.y = rounded(turn(0, 2) - turn(2, 0));
  result.z = rounded(turn(1, 0) - turn(0, 1));
  return result;
}

struct Interval {
  double low, high;
};

/// Bounds of a volume along any direction.
///
/// Let N be the length of a direction of the volume, X its largest absolute coordinate, and d a direction of length L
/// with integer components. The box bounds d . p through sum d_k p_k. The directions e_j of the volume's frame are
/// perpendicular, so d = sum kappa_j e_j / N^2 with the integers kappa_j = d . e_j, and the frame bounds d . p through
/// sum kappa_j (e_j . p) / N^2. Each bound is the sum of three slab middles, plus or minus the sum of the half-widths.
///
/// Rounding, with u = 2^-53:
///
/// - Limits along e_j are at most 2 N X; the sum of |kappa_j| is at most 2 L N, that of |d_k| at most 2 L. So a sum of
///   middles or half-widths is at most 4 L X.
/// - A middle or half-width has an error of u of 2 N X. A product, two sums and the product with the rounded 1 / N^2
///   add less than 5 u in all. So each of the two sums has an error of 24 u L X.
/// - Their sum and the last difference add 17 u L X.
///
/// The slack is 128 u L X, plus the smallest normal double for the loss to subnormal numbers. Where L X might overflow
/// there are no limits. NaN bounds nothing.
struct Frame_bounds {
  const Quospo& volume;
  Directions directions;
  double per_squared_length;
  double reach = 0;  ///< X
  double middle[3], half[3], turned_middle[3], turned_half[3];

  explicit Frame_bounds(const Quospo& v) : volume(v), directions(v.turn.directions()) {
    per_squared_length = 1 / (v.turn.length() * v.turn.length());
    for (int i = 0; i < 3; ++i) {
      reach = std::max(reach, std::max(-v.low[i], v.high[i]));
      middle[i] = v.low[i] / 2 + v.high[i] / 2, half[i] = v.high[i] / 2 - v.low[i] / 2;
      turned_middle[i] = v.turned_low[i] / 2 + v.turned_high[i] / 2;
      turned_half[i] = v.turned_high[i] / 2 - v.turned_low[i] / 2;
    }
  }

  Interval along(const std::array<double, 3>& d, double length) const {
    const double scale = length * reach;
    if (!(scale < 1e300)) return {-infinity, infinity};
    const double slack = 0x1p-46 * scale + std::numeric_limits<double>::min();
    double at = 0, width = 0, turned_at = 0, turned_width = 0;
    for (int j = 0; j < 3; ++j) {
      const auto& e = directions[j];
      const double kappa = d[0] * e[0] + d[1] * e[1] + d[2] * e[2];
      at += d[j] * middle[j], width += std::abs(d[j]) * half[j];
      turned_at += kappa * turned_middle[j], turned_width += std::abs(kappa) * turned_half[j];
    }
    turned_at *= per_squared_length, turned_width *= per_squared_length;
    Interval result{at - width - slack, at + width + slack};
    const Interval turned{turned_at - turned_width - slack, turned_at + turned_width + slack};
    if (turned.low > result.low) result.low = turned.low;
    if (turned.high < result.high) result.high = turned.high;
    return result;
  }
};

/// Whether a and b come within the margin of each other along the directions of a's frame.
bool near_along(const Quospo& a, const Directions& directions, const Frame_bounds& b, double margin) {
  const double length = a.turn.length();
  const double gap = margin > 0 ? 1.000000000000001 * length * margin + std::numeric_limits<double>::min() : 0;
  for (int i = 0; i < 3; ++i) {
    const Interval other = b.along(directions[i], length);
    if (a.turned_low[i] > other.high + gap || other.low > a.turned_high[i] + gap) return false;
  }
  return true;
}

/// Limits of two volumes along the directions of a frame.
struct Turned_limits {
  Quantised_turn turn;
  double low[3], high[3];

  Turned_limits(Quantised_turn of, const Frame_bounds& a, const Frame_bounds& b) : turn(of) {
    const auto directions = turn.directions();
    const double length = turn.length();
    const auto bounds = [&](const Frame_bounds& v, int i) -> Interval {
      if (v.volume.turn == turn) return {v.volume.turned_low[i], v.volume.turned_high[i]};
      return v.along(directions[i], length);
    };
    for (int i = 0; i < 3; ++i) {
      const Interval of_a = bounds(a, i), of_b = bounds(b, i);
      low[i] = std::min(of_a.low, of_b.low);
      high[i] = std::max(of_a.high, of_b.high);
    }
  }
  /// Half the surface area, in units of `size`.
  double surface(double size) const {
    double width[3];
    for (int i = 0; i < 3; ++i) width[i] = (high[i] - low[i]) / turn.length() / size;
    return width[0] * width[1] + width[1] * width[2] + width[2] * width[0];
  }
};

/// Principal axes of two solid boxes of equal mass: those of the two frames, centred on the middles of the volumes.
Eigen::Matrix3d joint_axes(const Frame_bounds& a, const Frame_bounds& b, double size) {
  const auto scaled_axes = [&](const Frame_bounds& v) {
    const double unit = size * v.volume.turn.length();
    Eigen::Matrix3d axes;
    for (int i = 0; i < 3; ++i)
      axes.row(i) = Eigen::RowVector3d(v.directions[i].data()) * (v.turned_half[i] / unit / v.volume.turn.length());
    return axes;
  };
  const Eigen::Matrix3d of_a = scaled_axes(a), of_b = scaled_axes(b);
  const Eigen::Vector3d way = Eigen::Vector3d(b.middle) / size - Eigen::Vector3d(a.middle) / size;
  return principal_axes((of_a.transpose() * of_a + of_b.transpose() * of_b) / 3 + way * way.transpose() / 2);
}

}  // namespace

/// The products and sums of a projection have an error of 3 u of the sum of their sizes, the last difference u of it.
/// The slack is 8 u of it. Integer multiples of subnormal numbers do not round: see `widen` for K_dop.
void Quospo::enclose(const Leaf_faces& faces) {
  turn = nearest_turn(principal_axes(faces));
  const auto directions = turn.directions();
  kernel::Frame frame{};
  for (int i = 0; i < 3; ++i) std::ranges::copy(directions[i], frame.axes[i]);
  const auto found = kernel::frame_limits(faces, frame);
  for (int i = 0; i < 3; ++i) low[i] = found.low[i], high[i] = found.high[i];
  for (int i = 0; i < 3; ++i) {
    double reach = 0;
    for (int k = 0; k < 3; ++k) reach += std::abs(directions[i][k]) * std::max(-low[k], high[k]);
    const bool bounded = reach < 1e307;
    turned_low[i] = bounded ? found.low[3 + i] - 0x1p-50 * reach : -infinity;
    turned_high[i] = bounded ? found.high[3 + i] + 0x1p-50 * reach : infinity;
  }
}

void Quospo::enclose(const Quospo& a, const Quospo& b) {
  const Frame_bounds bounds_a(a), bounds_b(b);
  Quospo both;
  for (int i = 0; i < 3; ++i) both.low[i] = std::min(a.low[i], b.low[i]), both.high[i] = std::max(a.high[i], b.high[i]);
  const double size = both.extent();
  Turned_limits best(a.turn, bounds_a, bounds_b);
  for (const auto other : {b.turn, nearest_turn(joint_axes(bounds_a, bounds_b, size))}) {
    if (other == best.turn) continue;
    const Turned_limits limits(other, bounds_a, bounds_b);
    if (limits.surface(size) < best.surface(size)) best = limits;
  }
  both.turn = best.turn;
  std::ranges::copy(best.low, both.turned_low);
  std::ranges::copy(best.high, both.turned_high);
  *this = both;
}

double Quospo::volume() const {
  const auto directions = turn.directions();
  std::vector<Slab> slabs{{{1, 0, 0}, low[0], high[0]}, {{0, 1, 0}, low[1], high[1]}, {{0, 0, 1}, low[2], high[2]}};
  for (int i = 0; i < 3; ++i)
    if (turn != Quantised_turn{})
      slabs.push_back({{directions[i][0], directions[i][1], directions[i][2]}, turned_low[i], turned_high[i]});
  return polytope_volume(slabs, bounds());
}

bool near_when_turned(const Quospo& a, const Quospo& b, double margin) {
  const Frame_bounds bounds_a(a), bounds_b(b);
  return near_along(a, bounds_a.directions, bounds_b, margin) && near_along(b, bounds_b.directions, bounds_a, margin);
}

}  // namespace lodestone
