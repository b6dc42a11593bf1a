// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/motion/expansion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

namespace lodestone::detail {

namespace {

using Vector = Kernel::Vector_3;

constexpr double roundings = 64 * 0x1p-53;

double length(const Vector& v) { return std::hypot(v.x(), v.y(), v.z()); }

/// Where points can be: in a ball and in a box, as offsets from the middle.
class Reach {
 public:
  explicit Reach(const CGAL::Bbox_3& box, const Point& middle)
      : low_(Point(box.xmin(), box.ymin(), box.zmin()) - middle),
        high_(Point(box.xmax(), box.ymax(), box.zmax()) - middle) {
    radius_ = farthest(length);
  }

  double radius() const { return radius_; }
  /// The largest value of a convex function that is nowhere more than the distance from the middle.
  template <class Measure>
  double farthest(Measure measure) const {
    double most = 0;
    for (int corner = 0; corner < 8; ++corner)
      most = std::max(most, measure(Vector(corner & 1 ? high_.x() : low_.x(), corner & 2 ? high_.y() : low_.y(),
                                           corner & 4 ? high_.z() : low_.z())));
    return longer * std::min(most, radius_);
  }

  void scale(double factor) {
    low_ = factor * low_;
    high_ = factor * high_;
    radius_ *= longer * factor;
  }
  void move(const Vector& way) {
    low_ = low_ + way;
    high_ = high_ + way;
    radius_ = longer * (radius_ + length(way));
  }
  /// Every point moves by no more than this along each axis.
  void grow(double distance) {
    const Vector all(distance, distance, distance);
    low_ = low_ - all;
    high_ = high_ + all;
    radius_ = longer * (radius_ + std::numbers::sqrt3 * distance);
  }
  /// Anywhere in a ball.
  void spread(double radius) {
    radius_ = longer * radius;
    high_ = Vector(radius_, radius_, radius_);
    low_ = -high_;
  }

 private:
  static constexpr double longer = 1 + 1e-9;

  Vector low_, high_;
  double radius_ = std::numeric_limits<double>::infinity();
};

/// Goes through the steps.
struct Expander {
  Reach reach;
  double middle;  ///< its distance from the origin
  Expansion result = {};

  void operator()(const Wobble_step& step) {
    const double height = std::abs(step.height), wave_number = std::abs(step.wave_number);
    add(1 + height * wave_number,
        roundings * (height * (wave_number * reach.radius() + std::abs(step.angle) + 8) + middle + reach.radius()));
    reach.grow(height + result.error);
  }
  void operator()(const Bend_step& step) {
    const double curvature = std::abs(step.curvature);
    const double aside = reach.farthest([&](const Vector& d) { return std::abs(d * step.towards); });
    const double askew = std::abs(step.axis * step.towards) + 16 * 0x1p-53;
    const double turned = reach.radius() * (1 + curvature * reach.radius());
    add(1 + curvature * aside, roundings * (middle + turned) + 16 * askew * turned);
    // The arc's chord is no longer than the arc, and what is perpendicular to it keeps its length.
    reach.spread(std::numbers::sqrt2 * reach.radius() + result.error);
  }
  void operator()(const Twist_step& step) {
    const double rate = std::abs(step.rate);
    const double from_axis = reach.farthest([&](const Vector& d) { return length(d - (d * step.axis) * step.axis); });
    const double shear = rate * from_axis;
    add(shear / 2 + std::hypot(1, shear / 2), roundings * (middle + reach.radius() * (1 + rate * reach.radius())));
    reach.spread(reach.radius() + result.error);
  }
  void operator()(const Inflate_step& step) {
    const double factor = std::abs(step.factor);
    add(factor, roundings * (middle + reach.radius() * (1 + factor)));
    reach.scale(factor);
    reach.grow(result.error);
  }
  void operator()(const Travel_step& step) {
    add(1, roundings * (middle + reach.radius() + length(step.way)));
    reach.move(step.way);
    reach.grow(result.error);
  }
  void operator()(const Spin_step&) {
    add(1, roundings * (middle + reach.radius()));
    reach.spread(reach.radius() + result.error);
  }

  void add(double constant, double error) {
    result.error = result.error * constant + error;
    result.constant *= constant;
  }
};

}  // namespace

Expansion expansion(std::span<const Step> steps, const Point& middle, const CGAL::Bbox_3& rest) {
  if (steps.empty()) return {};
  Expander expander{.reach = Reach(rest, middle), .middle = length(middle - CGAL::ORIGIN)};
  for (const Step& step : steps) std::visit(expander, step);
  const auto [constant, error] = expander.result;
  if (!std::isfinite(constant) || !std::isfinite(error))
    return {.constant = std::numeric_limits<double>::infinity(), .error = 0};
  return {.constant = constant * (1 + 1e-12), .error = error * (1 + 1e-12)};
}

}  // namespace lodestone::detail
