// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/motion/deformed_shape.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "io/shapes/directions.h"

namespace lodestone::detail {

namespace {

using Vector = Kernel::Vector_3;

double length_along(const std::vector<Point>& rest, const Point& middle, const Vector& direction) {
  double low = 0;
  double high = 0;
  for (const Point& p : rest) {
    const double u = (p - middle) * direction;
    low = std::min(low, u);
    high = std::max(high, u);
  }
  return high - low;
}

/// Radians per unit of length that give `degrees` over the whole shape. 0 for a shape that is flat along the axis,
/// which cannot be bent or twisted.
double angle_per_length(double length, double degrees) { return length > 0 ? degrees * degree / length : 0; }

double swing(double frame, double period, double phase) {
  return period == 0 ? 1 : std::sin(turn * (frame / period + phase));
}

/// sin(angle) / angle.
double sinc(double angle) { return angle == 0 ? 1 : std::sin(angle) / angle; }

/// Rotates `v` around the unit vector `axis` (Rodrigues' formula).
Vector rotated(const Vector& v, const Vector& axis, double angle) {
  const double cosine = std::cos(angle);
  return cosine * v + std::sin(angle) * CGAL::cross_product(axis, v) + ((1 - cosine) * (axis * v)) * axis;
}

Vector mean_velocity(const Way_point& from, const Way_point& to) { return (to.at - from.at) / (to.frame - from.frame); }

/// Velocity at way point `i` of a smooth path: the mean velocity from the preceding way point to the following one.
Vector velocity(const Travel& travel, std::size_t i) {
  const auto& way = travel.way_points;
  const std::size_t last = way.size() - 1;
  if (travel.path == Path::closed && (i == 0 || i == last))
    return (way[1].at - way[0].at + way[last].at - way[last - 1].at) /
           (way[1].frame - way[0].frame + way[last].frame - way[last - 1].frame);
  return mean_velocity(way[i == 0 ? 0 : i - 1], way[std::min(i + 1, last)]);
}

/// Cubic Hermite interpolation from way point `i` to the next, at the fraction `s` in [0, 1] of the time between them.
Vector on_smooth_path(const Travel& travel, std::size_t i, double s) {
  const Way_point& from = travel.way_points[i];
  const Way_point& to = travel.way_points[i + 1];
  const double duration = to.frame - from.frame;
  const double h = s * s * (3 - 2 * s);
  return (1 - h) * from.at + h * to.at + (duration * s * (1 - s) * (1 - s)) * velocity(travel, i) -
         (duration * s * s * (1 - s)) * velocity(travel, i + 1);
}

Vector place_in(const Travel& travel, double frame) {
  const auto& way = travel.way_points;
  const double duration = way.back().frame - way.front().frame;
  if (travel.path == Path::closed) {
    const double laps = std::floor((frame - way.front().frame) / duration);
    frame -= laps * duration;
  }
  if (frame <= way.front().frame) return way.front().at;
  if (frame >= way.back().frame) return way.back().at;

  const auto after = std::ranges::upper_bound(way, frame, {}, &Way_point::frame);
  const auto i = static_cast<std::size_t>(after - way.begin()) - 1;
  const double s = (frame - way[i].frame) / (way[i + 1].frame - way[i].frame);
  if (travel.path == Path::linear) return (1 - s) * way[i].at + s * way[i + 1].at;
  return on_smooth_path(travel, i, s);
}

/// The rest shape as the deformations see it.
struct Measures {
  Point middle;
  double half_diagonal;
  double length;  ///< along the axis of the deformation
};

/// None: it moves nothing.
std::optional<Step> step_at(const Wobble& wobble, const Measures& rest, double frame) {
  if (rest.half_diagonal == 0) return std::nullopt;
  return Wobble_step{.middle = rest.middle,
                     .wave_number = std::numbers::pi * wobble.waves / rest.half_diagonal,
                     .angle = turn * ((wobble.period == 0 ? 0 : frame / wobble.period) + wobble.phase),
                     .height = wobble.amplitude * rest.half_diagonal};
}

std::optional<Step> step_at(const Bend& bend, const Measures& rest, double frame) {
  const Vector axis = unit(bend.axis);
  return Bend_step{.middle = rest.middle,
                   .axis = axis,
                   .towards = unit(unit(bend.towards) - (unit(bend.towards) * axis) * axis),
                   .curvature = angle_per_length(rest.length, bend.degrees) * swing(frame, bend.period, bend.phase)};
}

std::optional<Step> step_at(const Twist& twist, const Measures& rest, double frame) {
  return Twist_step{.middle = rest.middle,
                    .axis = unit(twist.axis),
                    .rate = angle_per_length(rest.length, twist.degrees) * swing(frame, twist.period, twist.phase)};
}

std::optional<Step> step_at(const Inflate& inflate, const Measures& rest, double frame) {
  return Inflate_step{.middle = rest.middle,
                      .factor = 1 + (inflate.factor - 1) * std::min(frame / inflate.frames, 1.0)};
}

std::optional<Step> step_at(const Spin& spin, const Measures& rest, double frame) {
  return Spin_step{.middle = rest.middle, .axis = unit(spin.axis), .angle = degree * spin.degrees_per_frame * frame};
}

std::optional<Step> step_at(const Travel& travel, const Measures&, double frame) {
  return Travel_step{.way = place_in(travel, frame)};
}

/// The axis along which the deformation needs the length of the shape.
std::optional<Vector> measured_axis(const Deformation& deformation) {
  if (const auto* bend = std::get_if<Bend>(&deformation)) return unit(bend->axis);
  if (const auto* twist = std::get_if<Twist>(&deformation)) return unit(twist->axis);
  return std::nullopt;
}

}  // namespace

Point Wobble_step::operator()(const Point& p) const {
  const Vector d = p - middle;
  return p + height * Vector(std::sin(wave_number * d.y() + angle), std::sin(wave_number * d.z() + angle + turn / 3),
                             std::sin(wave_number * d.x() + angle + 2 * turn / 3));
}

Point Bend_step::operator()(const Point& p) const {
  const Vector d = p - middle;
  const double u = d * axis;
  const double w = d * towards;
  // With sin(x) / x, which stays accurate while the curvature passes through 0.
  const double angle = curvature * u;
  const double bent_u = u * sinc(angle) - w * std::sin(angle);
  const double bent_w = u * sinc(angle / 2) * std::sin(angle / 2) + w * std::cos(angle);
  return p + (bent_u - u) * axis + (bent_w - w) * towards;
}

Point Twist_step::operator()(const Point& p) const {
  const Vector d = p - middle;
  return middle + rotated(d, axis, rate * (d * axis));
}

Point Spin_step::operator()(const Point& p) const { return middle + rotated(p - middle, axis, angle); }

Deformed_shape::Deformed_shape(std::vector<Point> rest, std::vector<Deformation> deformations)
    : rest_(std::move(rest)), deformations_(std::move(deformations)) {
  for (const Deformation& deformation : deformations_) check(deformation);
  if (!rest_.empty()) {
    box_ = CGAL::Bbox_3();
    for (const Point& p : rest_) box_ += p.bbox();
    const Point low(box_.xmin(), box_.ymin(), box_.zmin());
    const Point high(box_.xmax(), box_.ymax(), box_.zmax());
    middle_ = CGAL::midpoint(low, high);
    half_diagonal_ = std::sqrt(CGAL::squared_distance(low, high)) / 2;
  }
  for (const Deformation& deformation : deformations_) {
    const auto axis = measured_axis(deformation);
    lengths_.push_back(axis ? length_along(rest_, middle_, *axis) : 0);
  }
}

Deformed_shape Deformed_shape::part(std::span<const std::uint32_t> points) const {
  Deformed_shape result = *this;
  result.rest_.clear();
  result.rest_.reserve(points.size());
  for (const std::uint32_t point : points) result.rest_.push_back(rest_.at(point));
  return result;
}

std::vector<Step> Deformed_shape::steps_at(double frame) const {
  std::vector<Step> steps;
  for (std::size_t i = 0; i < deformations_.size(); ++i) {
    const Measures rest{.middle = middle_, .half_diagonal = half_diagonal_, .length = lengths_[i]};
    if (const auto step = std::visit([&](const auto& d) { return step_at(d, rest, frame); }, deformations_[i]))
      steps.push_back(*step);
  }
  return steps;
}

}  // namespace lodestone::detail
