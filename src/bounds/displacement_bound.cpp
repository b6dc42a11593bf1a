// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/bounds/displacement_bound.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bounds/grown_box.h"
#include "bounds/node_lists.h"
#include "lodestone/bounds/node_regions.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/rigid_motion.h"
#include "lodestone/tree/region_tree.h"

namespace lodestone {

namespace {

constexpr double underflow = 0x1p-1070;

/// The sum, or more.
double sum_above(double a, double b) { return b == 0 ? a : next_above(a + b); }

/// `now` - `then`, or more. A sum that has overflowed says nothing any more.
double growth(double now, double then) {
  if (std::isinf(now)) return now;
  return now == then ? 0 : next_above(now - then);
}

}  // namespace

Displacement_bound::Displacement_bound(const Displacement_promise& promise, const Bounded_object& object)
    : promise_(&promise),
      layout_(&object.layout),
      last_(object.layout.node_count()),
      parents_(object.layout.parents()) {
  check_object(object);
  const bool tells_apart = promise.region_count() > 1;
  if (tells_apart && object.labels.empty())
    throw Bad_argument(
        fmt::format("displacements are promised for {} regions, the object has none", promise.region_count()));
  if (tells_apart)
    for (const auto label : object.labels)
      if (label >= promise.region_count())
        throw Bad_argument(fmt::format("a vertex is in region {}, displacements are promised for {} regions", label,
                                       promise.region_count()));
  regions_ = node_regions(object.layout, tells_apart ? object.labels : std::span<const Region_index>());
  const auto boxes = fitted_boxes(object.layout, object.rest);
  for (auto node = static_cast<std::uint32_t>(node_count()); node-- > 0;) {
    last_[node].total = total(node);
    if (layout_->is_leaf(node)) {
      last_[node].box = in_frame(layout_->node(node).leaf, boxes[node], object.rest);
      continue;
    }
    last_[node].box = around_children(node);
  }
}

double Displacement_bound::total(std::uint32_t node) const { return promise_->total(regions_[node]); }

/// The last box, grown until now, in the rigid frame.
Aabb Displacement_bound::now(std::uint32_t node) const {
  return grown(last_[node].box, growth(total(node), last_[node].total));
}

Aabb Displacement_bound::box(std::uint32_t node) const {
  return promise_->frame_ ? promise_->frame_->to_world(now(node)) : now(node);
}

Aabb Displacement_bound::in_frame(std::uint32_t leaf, const Aabb& fitted, Coordinates coordinates) const {
  return promise_->frame_ ? promise_->frame_->to_frame(layout_->vertices(leaf), coordinates) : fitted;
}

Aabb Displacement_bound::around_children(std::uint32_t node) const {
  Aabb box;
  box.enclose(now(node + 1), now(layout_->node(node).second_child));
  return box;
}

/// If the leaf lies outside of its own box, the promise is broken, and boxes above it are wrong too. They are replaced,
/// never intersected with what they were, so that they are right again once the surface has been read.
bool Displacement_bound::note_read(std::uint32_t leaf, const Aabb& fitted, Coordinates coordinates) {
  std::uint32_t node = layout_->leaf_node(leaf);
  last_[node] = {.box = in_frame(leaf, fitted, coordinates), .total = total(node)};
  while (node != 0) {
    node = parents_[node];
    const Last_box next{.box = around_children(node), .total = total(node)};
    // Only with an equal total is the box known to be what those above it were made from, without rounding.
    if (next.total == last_[node].total && next.box == last_[node].box) return true;
    last_[node] = next;
  }
  return true;
}

bool Displacement_bound::note_all(std::span<const Aabb> fitted, Coordinates /*coordinates*/, bool /*all*/) {
  for (auto node = static_cast<std::uint32_t>(node_count()); node-- > 0;) {
    last_[node].total = total(node);
    if (!promise_->frame_)
      last_[node].box = fitted[node];
    else if (layout_->is_leaf(node))
      last_[node].box = promise_->frame_->to_frame(fitted[node]);
    else
      last_[node].box = around_children(node);
  }
  return true;
}

Displacement_promise::Displacement_promise(std::size_t regions) : totals_(regions, 0.0) {
  if (regions == 0) throw Bad_argument("displacements are promised for at least one region");
}

void Displacement_promise::move(double distance) { move(std::vector(totals_.size(), distance)); }

void Displacement_promise::move(double distance, const Eigen::Isometry3d& frame) {
  move(std::vector(totals_.size(), distance), frame);
}

void Displacement_promise::move(std::span<const double> per_region) {
  check(per_region);
  for (std::size_t i = 0; i < totals_.size(); ++i) totals_[i] = sum_above(totals_[i], per_region[i]);
  largest_total_ = sum_above(largest_total_, std::ranges::max(per_region));
}

void Displacement_promise::move(std::span<const double> per_region, const Eigen::Isometry3d& frame) {
  check(per_region);
  frame_ = checked(frame);
  move(per_region);
}

double Displacement_promise::total(Region_index region) const {
  return region == several_regions ? largest_total_ : totals_[region];
}

void Displacement_promise::check(std::span<const double> per_region) const {
  if (per_region.size() != totals_.size())
    throw Bad_argument(fmt::format("{} displacements for {} regions", per_region.size(), totals_.size()));
  for (const double distance : per_region)
    if (!(distance >= 0) || !std::isfinite(distance)) throw Bad_argument("a displacement must be >= 0 and finite");
}

/// None for the identity.
std::optional<Displacement_promise::Rigid_frame> Displacement_promise::checked(const Eigen::Isometry3d& frame) {
  if (!make_rigid_motion(frame)) return std::nullopt;
  const Eigen::Matrix3d rotation = frame.linear();
  // Each of the nine entries is rounded less than 4 times, and is about 1 at most.
  const double defect = (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).norm() + 32 * unit_roundoff;
  return Rigid_frame{.rotation = rotation, .translation = frame.translation(), .defect = defect};
}

Aabb Displacement_promise::Rigid_frame::to_world(const Aabb& box) const {
  Aabb world{};
  for (Eigen::Index row = 0; row < 3; ++row) {
    double low = translation[row], high = low, magnitude = std::abs(low);
    for (Eigen::Index column = 0; column < 3; ++column) {
      const double factor = rotation(row, column);
      const double one = factor * box.low[column], other = factor * box.high[column];
      low += std::min(one, other);
      high += std::max(one, other);
      magnitude += std::max(std::abs(one), std::abs(other));
    }
    const double margin = 32 * unit_roundoff * magnitude + underflow;
    world.low[row] = low - margin;
    world.high[row] = high + margin;
    open_if_not_finite(world, static_cast<std::size_t>(row));
  }
  return world;
}

Aabb Displacement_promise::Rigid_frame::to_frame(std::span<const std::uint32_t> vertices,
                                                 Coordinates coordinates) const {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  double farthest = 0;
  for (const auto vertex : vertices) {
    const Eigen::Vector3d from_origin =
        Eigen::Map<const Eigen::Vector3d>(coordinates.data() + 3 * std::size_t{vertex}) - translation;
    const Eigen::Vector3d q = rotation.transpose() * from_origin;
    low = low.cwiseMin(q);
    high = high.cwiseMax(q);
    farthest = std::max(farthest, from_origin.lpNorm<1>());
  }
  const double margin = margin_to_frame(farthest);
  Aabb box{};
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    box.low[axis] = low[axis] - margin;
    box.high[axis] = high[axis] + margin;
    open_if_not_finite(box, static_cast<std::size_t>(axis));
  }
  return box;
}

Aabb Displacement_promise::Rigid_frame::to_frame(const Aabb& box) const {
  const Eigen::Vector3d low = Eigen::Map<const Eigen::Vector3d>(box.low) - translation;
  const Eigen::Vector3d high = Eigen::Map<const Eigen::Vector3d>(box.high) - translation;
  const double margin = margin_to_frame(low.cwiseAbs().cwiseMax(high.cwiseAbs()).sum());
  Aabb turned{};
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d one = rotation.col(axis).cwiseProduct(low), other = rotation.col(axis).cwiseProduct(high);
    turned.low[axis] = one.cwiseMin(other).sum() - margin;
    turned.high[axis] = one.cwiseMax(other).sum() + margin;
    open_if_not_finite(turned, static_cast<std::size_t>(axis));
  }
  return turned;
}

/// How far ends are moved outwards for vertices that are at most so far from where the frame is.
double Displacement_promise::Rigid_frame::margin_to_frame(double farthest) const {
  return (2 * defect + 64 * unit_roundoff) * farthest + 64 * unit_roundoff * translation.lpNorm<1>() + underflow;
}

}  // namespace lodestone
