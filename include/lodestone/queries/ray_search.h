// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "lodestone/bounds/bounded_surface.h"
#include "lodestone/queries/node_boxes.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

/// The points origin + t direction with 0 <= t <= length.
struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();         ///< finite
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();     ///< finite, not zero; need not be of unit length
  double length = std::numeric_limits<double>::infinity();  ///< >= 0, in multiples of `direction`
};

/// Where a ray meets a face first.
///
/// Which faces a ray meets, and which of them first, is decided exactly; faces are closed sets. Where the ray runs in
/// the plane of a face, or the face is a segment or a point, this is the first common point. `t` and `point` are
/// rounded.
struct Ray_hit {
  std::uint32_t face = 0;  ///< its index
  double t = 0;  ///< in multiples of `direction`; relative error below 2^-30 if it is a normal number; infinity
                 ///< if it exceeds the largest double
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< origin + t direction
};

/// The first face that a ray meets; of several at the same t the one with the lowest index. None if it meets no face.
///
/// Nodes are visited from front to back. O(log F + leaves whose boxes the ray meets before its first face).
/// @param surface  with boxes
/// @throws Bad_argument  the ray is not as `Ray` says
std::optional<Ray_hit> first_hit(const Layout_view& surface, const Ray& ray);

/// The same for a surface that is bounded: only leaves whose boxes the ray meets before its first face are posed. Where
/// a position is found outside its bound, the surface is posed as a whole; a bound that is broken elsewhere goes
/// unnoticed.
/// @throws Bad_argument  the ray is not as `Ray` says
/// @throws Bad_mesh      a coordinate that is read is not finite
std::optional<Ray_hit> first_hit(Bounded_surface& surface, const Ray& ray);

/// All faces that a ray meets, by t, and those at the same t by index. The order is exact, so `t` can fall by its error
/// from one hit to the next. O(log F + leaves whose boxes the ray meets).
/// @param surface  with boxes
/// @throws Bad_argument  the ray is not as `Ray` says
std::vector<Ray_hit> all_hits(const Layout_view& surface, const Ray& ray);

/// The same for a surface that is bounded: see `first_hit`.
std::vector<Ray_hit> all_hits(Bounded_surface& surface, const Ray& ray);

/// Whether a ray meets one triangle before another: at which it has its first common point, as in `Ray_hit`. Exact.
/// @param ray  meets both, if it is long enough
bool meets_before(const Ray& ray, const Triangle& a, const Triangle& b);

/// `first_hit` for trees of any volumes: `Node_boxes` are fitted where they are no boxes.
template <Bounding_volume Volume>
std::optional<Ray_hit> first_hit(const Basic_tree_view<Volume>& surface, const Ray& ray) {
  return first_hit(Node_boxes(surface).layout(), ray);
}

/// `all_hits` for trees of any volumes.
template <Bounding_volume Volume>
std::vector<Ray_hit> all_hits(const Basic_tree_view<Volume>& surface, const Ray& ray) {
  return all_hits(Node_boxes(surface).layout(), ray);
}

}  // namespace lodestone
