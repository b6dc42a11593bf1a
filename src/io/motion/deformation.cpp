// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/motion/deformation.h"

#include <fmt/format.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "io/shapes/directions.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

using Vector = Kernel::Vector_3;

using detail::degree;
using detail::turn;
using detail::unit;

// ---- Geometry ----

/// The properties of the rest shape that deformations use.
struct Rest_shape {
  std::vector<Point> points;
  Point middle{0, 0, 0};
  double half_diagonal = 0;
};

Rest_shape measure(std::vector<Point> points) {
  Rest_shape rest{std::move(points), Point(0, 0, 0), 0};
  if (rest.points.empty()) return rest;
  CGAL::Bbox_3 box;
  for (const Point& p : rest.points) box += p.bbox();
  const Point low(box.xmin(), box.ymin(), box.zmin());
  const Point high(box.xmax(), box.ymax(), box.zmax());
  rest.middle = CGAL::midpoint(low, high);
  rest.half_diagonal = std::sqrt(CGAL::squared_distance(low, high)) / 2;
  return rest;
}

double length_along(const Rest_shape& rest, const Vector& direction) {
  double low = 0;
  double high = 0;
  for (const Point& p : rest.points) {
    const double u = (p - rest.middle) * direction;
    low = std::min(low, u);
    high = std::max(high, u);
  }
  return high - low;
}

/// Radians per unit of length that give `degrees` over the whole shape. 0 for a shape that is flat along the axis,
/// which cannot be bent or twisted.
double angle_per_length(const Rest_shape& rest, const Vector& axis, double degrees) {
  const double length = length_along(rest, axis);
  return length > 0 ? degrees * degree / length : 0;
}

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

// ---- One function per deformation: all positions of one frame ----

void apply(const Wobble& wobble, const Rest_shape& rest, double frame, std::span<Point> positions) {
  if (rest.half_diagonal == 0) return;
  const double k = std::numbers::pi * wobble.waves / rest.half_diagonal;
  const double a = turn * ((wobble.period == 0 ? 0 : frame / wobble.period) + wobble.phase);
  const double height = wobble.amplitude * rest.half_diagonal;
  for (Point& p : positions) {
    const Vector d = p - rest.middle;
    p = p + height * Vector(std::sin(k * d.y() + a), std::sin(k * d.z() + a + turn / 3),
                            std::sin(k * d.x() + a + 2 * turn / 3));
  }
}

void apply(const Bend& bend, const Rest_shape& rest, double frame, std::span<Point> positions) {
  const Vector axis = unit(bend.axis);
  const Vector towards = unit(unit(bend.towards) - (unit(bend.towards) * axis) * axis);
  const double curvature = angle_per_length(rest, axis, bend.degrees) * swing(frame, bend.period, bend.phase);
  for (Point& p : positions) {
    const Vector d = p - rest.middle;
    const double u = d * axis;
    const double w = d * towards;
    // With sin(x) / x, which stays accurate while the curvature passes through 0.
    const double angle = curvature * u;
    const double bent_u = u * sinc(angle) - w * std::sin(angle);
    const double bent_w = u * sinc(angle / 2) * std::sin(angle / 2) + w * std::cos(angle);
    p = p + (bent_u - u) * axis + (bent_w - w) * towards;
  }
}

void apply(const Twist& twist, const Rest_shape& rest, double frame, std::span<Point> positions) {
  const Vector axis = unit(twist.axis);
  const double rate = angle_per_length(rest, axis, twist.degrees) * swing(frame, twist.period, twist.phase);
  for (Point& p : positions) {
    const Vector d = p - rest.middle;
    p = rest.middle + rotated(d, axis, rate * (d * axis));
  }
}

void apply(const Inflate& inflate, const Rest_shape& rest, double frame, std::span<Point> positions) {
  const double factor = 1 + (inflate.factor - 1) * std::min(frame / inflate.frames, 1.0);
  for (Point& p : positions) p = rest.middle + factor * (p - rest.middle);
}

void apply(const Spin& spin, const Rest_shape& rest, double frame, std::span<Point> positions) {
  const Vector axis = unit(spin.axis);
  const double angle = degree * spin.degrees_per_frame * frame;
  for (Point& p : positions) p = rest.middle + rotated(p - rest.middle, axis, angle);
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

void apply(const Travel& travel, const Rest_shape&, double frame, std::span<Point> positions) {
  const Vector way = place_in(travel, frame);
  for (Point& p : positions) p = p + way;
}

// ---- Checks ----

void require(bool holds, std::string_view what) {
  if (!holds) throw Bad_argument(std::string(what));
}

void check_number(std::string_view what, double value) {
  require(std::isfinite(value), fmt::format("{} is {}, must be finite", what, value));
}

void check_at_least_zero(std::string_view what, double value) {
  require(value >= 0 && std::isfinite(value), fmt::format("{} is {}, must be >= 0 and finite", what, value));
}

void check_positive(std::string_view what, double value) {
  require(value > 0 && std::isfinite(value), fmt::format("{} is {}, must be > 0 and finite", what, value));
}

void check_direction(std::string_view what, const Vector& v) {
  require(detail::is_direction(v), fmt::format("{} must be finite and not zero", what));
}

void check_fields(const Wobble& wobble) {
  check_number("amplitude", wobble.amplitude);
  check_number("waves", wobble.waves);
  check_at_least_zero("period", wobble.period);
  check_number("phase", wobble.phase);
}

void check_fields(const Bend& bend) {
  check_direction("axis", bend.axis);
  check_direction("towards", bend.towards);
  const Vector axis = unit(bend.axis);
  const Vector towards = unit(bend.towards);
  require(CGAL::cross_product(axis, towards).squared_length() > 1e-12, "towards is parallel to axis");
  check_number("degrees", bend.degrees);
  check_at_least_zero("period", bend.period);
  check_number("phase", bend.phase);
}

void check_fields(const Twist& twist) {
  check_direction("axis", twist.axis);
  check_number("degrees", twist.degrees);
  check_at_least_zero("period", twist.period);
  check_number("phase", twist.phase);
}

void check_fields(const Inflate& inflate) {
  check_positive("factor", inflate.factor);
  check_positive("frames", inflate.frames);
}

void check_fields(const Travel& travel) {
  const auto& way = travel.way_points;
  require(!way.empty(), "way_points is empty");
  for (std::size_t i = 0; i < way.size(); ++i) {
    check_number("frame of a way point", way[i].frame);
    for (int axis = 0; axis < 3; ++axis) check_number("coordinate of a way point", way[i].at[axis]);
    require(i == 0 || way[i - 1].frame < way[i].frame, fmt::format("way point {} is not after the one before", i));
  }
  if (travel.path != Path::closed) return;
  require(way.size() >= 3, "a closed path needs three way points");
  require(way.front().at == way.back().at, "a closed path must end where it starts");
}

void check_fields(const Spin& spin) {
  check_direction("axis", spin.axis);
  check_number("degrees_per_frame", spin.degrees_per_frame);
}

}  // namespace

void check(const Deformation& deformation) {
  std::visit([](const auto& d) { check_fields(d); }, deformation);
}

Motion deform(std::vector<Point> rest, std::vector<Deformation> deformations) {
  for (const Deformation& deformation : deformations) check(deformation);
  auto pose = [shape = measure(std::move(rest)), steps = std::move(deformations)](std::size_t frame,
                                                                                  std::span<Point> positions) {
    if (positions.size() != shape.points.size())
      throw Bad_motion(fmt::format("positions of {} vertices are requested, the shape has {}", positions.size(),
                                   shape.points.size()));
    std::ranges::copy(shape.points, positions.begin());
    for (const Deformation& step : steps)
      std::visit([&](const auto& d) { apply(d, shape, double(frame), positions); }, step);
  };
  return {.frames = 0, .pose = std::move(pose)};
}

}  // namespace lodestone
