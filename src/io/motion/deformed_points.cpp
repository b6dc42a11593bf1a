// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/motion/deformed_points.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "io/motion/deformed_shape.h"
#include "io/motion/expansion.h"
#include "lodestone/bounds/lipschitz_bound.h"
#include "lodestone/mesh/errors.h"
#include "mesh/coordinates_of.h"

namespace lodestone {

struct Deformed_points::State {
  explicit State(detail::Deformed_shape rest_and_deformations) : shape(std::move(rest_and_deformations)) {}

  detail::Deformed_shape shape;
  std::vector<detail::Step> steps;  ///< of the current frame

  Lipschitz_promise promise;  ///< of the current frame
  detail::Expansion expansion() const { return detail::expansion(steps, shape.middle(), shape.box()); }
};

Deformed_points::Deformed_points(std::vector<Point> rest, std::vector<Deformation> deformations)
    : Deformed_points(detail::Deformed_shape(std::move(rest), std::move(deformations))) {}
Deformed_points::Deformed_points(detail::Deformed_shape shape) : state_(std::make_unique<State>(std::move(shape))) {
  set_frame(0);
}
Deformed_points::~Deformed_points() = default;
Deformed_points::Deformed_points(Deformed_points&&) noexcept = default;
Deformed_points& Deformed_points::operator=(Deformed_points&&) noexcept = default;

void Deformed_points::set_frame(double frame) {
  if (!(frame >= 0) || !std::isfinite(frame))
    throw Bad_argument(fmt::format("frame {} of a deformation, must be >= 0 and finite", frame));
  state_->steps = state_->shape.steps_at(frame);
  const auto [constant, error] = state_->expansion();
  state_->promise.set_constant(constant, error);
  ++pose_number_;
}

std::uint32_t Deformed_points::vertex_count() const { return static_cast<std::uint32_t>(state_->shape.rest().size()); }

double Deformed_points::lipschitz_constant() const { return state_->expansion().constant; }

double Deformed_points::position_error() const { return state_->expansion().error; }

namespace {

/// A bound that reads its own positions.
struct Deformed_bound {
  std::unique_ptr<const Position_source> positions;
  Lipschitz_bound bound;

  std::size_t node_count() const { return bound.node_count(); }
  Aabb box(std::uint32_t node) const { return bound.box(node); }
  Aabb box(std::uint32_t node, std::vector<Eigen::Vector3d>& read) const { return bound.box(node, read); }
};

}  // namespace

Any_bound Deformed_points::bound(const Bounded_object& object) const {
  auto positions = std::make_unique<const Computed_source<Deformed_points>>(*this);
  const std::vector<double> rest = coordinates_of(state_->shape.rest());
  auto bound =
      state_->promise.bound({.layout = object.layout, .labels = object.labels, .rest = rest, .positions = *positions});
  return Any_bound(Deformed_bound{std::move(positions), std::move(bound)});
}

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
