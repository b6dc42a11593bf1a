// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/motion/deformation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "io/motion/deformed_shape.h"
#include "io/shapes/directions.h"
#include "lodestone/io/motion/computed_motion.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

using Vector = Kernel::Vector_3;
using detail::unit;

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
  const auto shape = std::make_shared<const detail::Deformed_shape>(std::move(rest), std::move(deformations));
  auto pose = [shape](std::size_t frame, std::span<Point> positions) {
    if (positions.size() != shape->rest().size())
      throw Bad_motion(fmt::format("positions of {} vertices are requested, the shape has {}", positions.size(),
                                   shape->rest().size()));
    std::ranges::copy(shape->rest(), positions.begin());
    for (const detail::Step& step : shape->steps_at(static_cast<double>(frame)))
      std::visit(
          [&](const auto& move) {
            for (Point& p : positions) p = move(p);
          },
          step);
  };
  auto computed = [shape](std::span<const std::uint32_t> vertices) {
    return detail::computed_deformation(*shape, vertices);
  };
  return {.frames = 0, .pose = std::move(pose), .computed = std::move(computed)};
}

}  // namespace lodestone
