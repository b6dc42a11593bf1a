// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/motion/computed_motion.h"

#include <concepts>
#include <utility>

#include "io/motion/deformed_shape.h"
#include "lodestone/bounds/linear_bound.h"
#include "lodestone/bounds/placed_bound.h"
#include "lodestone/io/motion/deformed_points.h"
#include "mesh/coordinates_of.h"

namespace lodestone {
namespace {

/// Computed points as a motion. Morphed_points without targets are a shape at rest: they stay where they are, and their
/// boxes are exact.
template <class Points>
class Motion_of final : public Computed_motion {
 public:
  explicit Motion_of(Points points) : points_(std::move(points)) {}

  void set_frame(std::size_t frame) override {
    if constexpr (is_deforming) points_.set_frame(static_cast<double>(frame));
  }
  Any_bound bound(const Bounded_object& object) const override {
    if constexpr (is_deforming)
      return points_.bound(object);
    else
      return Any_bound(Linear_bound(points_, object.layout));
  }
  std::uint32_t vertex_count() const override { return points_.vertex_count(); }
  std::uint64_t pose_number() const override { return points_.pose_number(); }
  Eigen::Vector3d operator()(std::uint32_t vertex) const override { return points_(vertex); }
  void pose(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const override {
    points_.pose(vertices, coordinates);
  }
  void pose_all(std::span<double> coordinates) const override { points_.pose_all(coordinates); }

 private:
  static constexpr bool is_deforming = std::same_as<Points, Deformed_points>;

  Points points_;
};

/// Another motion, changed.
class Changed : public Computed_motion {
 public:
  explicit Changed(std::unique_ptr<Computed_motion> motion) : inner_(std::move(motion)) {}

  void set_frame(std::size_t frame) override { inner_->set_frame(frame); }
  Any_bound bound(const Bounded_object& object) const override { return inner_->bound(object); }
  std::uint32_t vertex_count() const override { return inner_->vertex_count(); }
  std::uint64_t pose_number() const override { return inner_->pose_number(); }
  Eigen::Vector3d operator()(std::uint32_t vertex) const override { return (*inner_)(vertex); }
  void pose(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const override {
    inner_->pose(vertices, coordinates);
  }
  void pose_all(std::span<double> coordinates) const override { inner_->pose_all(coordinates); }

 protected:
  std::unique_ptr<Computed_motion> inner_;
};

class Placed final : public Changed {
 public:
  Placed(std::unique_ptr<Computed_motion> motion, const Kernel::Aff_transformation_3& placement)
      : Changed(std::move(motion)), placement_(placement) {
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) linear_(row, column) = placement_.m(row, column);
      translation_[row] = placement_.m(row, 3);
    }
  }

  Any_bound bound(const Bounded_object& object) const override {
    return Any_bound(Placed_box{inner_->bound(object), this});
  }
  Eigen::Vector3d operator()(std::uint32_t vertex) const override { return placed((*inner_)(vertex)); }
  void pose(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const override {
    inner_->pose(vertices, coordinates);
    for (const std::uint32_t vertex : vertices) {
      Eigen::Map<Eigen::Vector3d> position(coordinates.data() + 3 * std::size_t{vertex});
      position = placed(position);
    }
  }
  void pose_all(std::span<double> coordinates) const override {
    inner_->pose_all(coordinates);
    for (std::size_t i = 0; i < coordinates.size(); i += 3) {
      Eigen::Map<Eigen::Vector3d> position(coordinates.data() + i);
      position = placed(position);
    }
  }

 private:
  struct Placed_box {
    Any_bound inner;
    const Placed* motion;
    std::size_t node_count() const { return inner.node_count(); }
    Aabb box(std::uint32_t node) const { return placed_box(motion->linear_, motion->translation_, inner.box(node)); }
  };
  Eigen::Vector3d placed(const Eigen::Vector3d& position) const {
    const Point p = Point(position.x(), position.y(), position.z()).transform(placement_);
    return {p.x(), p.y(), p.z()};
  }

  Kernel::Aff_transformation_3 placement_;
  Eigen::Matrix3d linear_;
  Eigen::Vector3d translation_;
};

class Held final : public Changed {
 public:
  Held(std::unique_ptr<Computed_motion> motion, std::size_t last) : Changed(std::move(motion)), last_(last) {}
  void set_frame(std::size_t frame) override {
    if (frame <= last_)
      inner_->set_frame(frame);
    else if (!ended_)
      inner_->set_frame(last_);
    ended_ = frame >= last_;
  }
  const Skinned_points* skin() const override { return inner_->skin(); }

 private:
  std::size_t last_;
  bool ended_ = false;  ///< whether it is in the last pose, which need not be set again
};

}  // namespace

std::unique_ptr<Computed_motion> detail::computed_deformation(const Deformed_shape& shape,
                                                              std::span<const std::uint32_t> vertices) {
  auto part = shape.part(vertices);
  if (shape.deformations().empty())
    return std::make_unique<Motion_of<Morphed_points>>(Morphed_points(coordinates_of(part.rest())));
  return std::make_unique<Motion_of<Deformed_points>>(Deformed_points(std::move(part)));
}

std::unique_ptr<Computed_motion> placed(std::unique_ptr<Computed_motion> motion,
                                        const Kernel::Aff_transformation_3& placement) {
  return std::make_unique<Placed>(std::move(motion), placement);
}

std::unique_ptr<Computed_motion> held(std::unique_ptr<Computed_motion> motion, std::size_t last_frame) {
  return std::make_unique<Held>(std::move(motion), last_frame);
}

}  // namespace lodestone
