// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/motion/deformed_points.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "io/motion/deformed_shape.h"
#include "io/motion/expansion.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {

struct Deformed_points::State {
  detail::Deformed_shape shape;
  std::vector<detail::Step> steps;  ///< of the current frame

  detail::Expansion expansion() const { return detail::expansion(steps, shape.middle(), shape.box()); }
};

Deformed_points::Deformed_points(std::vector<Point> rest, std::vector<Deformation> deformations)
    : state_(std::make_unique<State>(detail::Deformed_shape(std::move(rest), std::move(deformations)))) {
  state_->steps = state_->shape.steps_at(0);
}
Deformed_points::~Deformed_points() = default;
Deformed_points::Deformed_points(Deformed_points&&) noexcept = default;
Deformed_points& Deformed_points::operator=(Deformed_points&&) noexcept = default;

void Deformed_points::set_frame(double frame) {
  if (!(frame >= 0) || !std::isfinite(frame))
    throw Bad_argument(fmt::format("frame {} of a deformation, must be >= 0 and finite", frame));
  state_->steps = state_->shape.steps_at(frame);
  ++pose_number_;
}

std::uint32_t Deformed_points::vertex_count() const { return static_cast<std::uint32_t>(state_->shape.rest().size()); }

double Deformed_points::lipschitz_constant() const { return state_->expansion().constant; }

double Deformed_points::position_error() const { return state_->expansion().error; }

Eigen::Vector3d Deformed_points::operator()(std::uint32_t vertex) const {
  Point p = state_->shape.rest()[vertex];
  for (const detail::Step& step : state_->steps) p = std::visit([&](const auto& move) { return move(p); }, step);
  return {p.x(), p.y(), p.z()};
}

void Deformed_points::pose(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const {
  for (const auto vertex : vertices)
    Eigen::Map<Eigen::Vector3d>(coordinates.data() + 3 * std::size_t{vertex}) = (*this)(vertex);
}

void Deformed_points::pose_all(std::span<double> coordinates) const {
  for (std::uint32_t vertex = 0; vertex < vertex_count(); ++vertex)
    Eigen::Map<Eigen::Vector3d>(coordinates.data() + 3 * std::size_t{vertex}) = (*this)(vertex);
}

}  // namespace lodestone
