// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Bbox_3.h>

#include <cstdint>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "lodestone/io/motion/computed_motion.h"
#include "lodestone/io/motion/deformation.h"
#include "lodestone/mesh/concepts.h"

/// Built-in deformations of one shape, frame by frame.
namespace lodestone::detail {

// What each deformation does to a point in one frame.
struct Wobble_step {
  Point middle;
  double wave_number, angle, height;
  Point operator()(const Point& p) const;
};
struct Bend_step {
  Point middle;
  Kernel::Vector_3 axis, towards;
  double curvature;
  Point operator()(const Point& p) const;
};
struct Twist_step {
  Point middle;
  Kernel::Vector_3 axis;
  double rate;
  Point operator()(const Point& p) const;
};
struct Inflate_step {
  Point middle;
  double factor;
  Point operator()(const Point& p) const { return middle + factor * (p - middle); }
};
struct Travel_step {
  Kernel::Vector_3 way;
  Point operator()(const Point& p) const { return p + way; }
};
struct Spin_step {
  Point middle;
  Kernel::Vector_3 axis;
  double angle;
  Point operator()(const Point& p) const;
};
using Step = std::variant<Wobble_step, Bend_step, Twist_step, Inflate_step, Travel_step, Spin_step>;

/// A shape at rest, and the deformations that are applied to it in order.
class Deformed_shape {
 public:
  /// @throws Bad_argument  as `check`
  Deformed_shape(std::vector<Point> rest, std::vector<Deformation> deformations);

  /// Some of its points, which the deformations move as they do in the whole shape.
  Deformed_shape part(std::span<const std::uint32_t> points) const;

  const std::vector<Point>& rest() const { return rest_; }
  const std::vector<Deformation>& deformations() const { return deformations_; }
  const CGAL::Bbox_3& box() const { return box_; }  ///< of the points at rest
  const Point& middle() const { return middle_; }   ///< of the box
  /// What moves the points in a frame. O(deformations).
  std::vector<Step> steps_at(double frame) const;

 private:
  std::vector<Point> rest_;
  std::vector<Deformation> deformations_;
  CGAL::Bbox_3 box_{0, 0, 0, 0, 0, 0};
  Point middle_{0, 0, 0};        ///< of the bounding box
  double half_diagonal_ = 0;     ///< of the bounding box
  std::vector<double> lengths_;  ///< per deformation: how long the shape is along its axis
};

/// Some points of a shape, as its deformations move them.
/// @param vertices  their indices in the shape
std::unique_ptr<Computed_motion> computed_deformation(const Deformed_shape& shape,
                                                      std::span<const std::uint32_t> vertices);

}  // namespace lodestone::detail
