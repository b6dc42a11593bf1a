// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lodestone/queries/ray_search.h"
#include "triangles/ray_depth.h"

/// What searches along a ray collect.
namespace lodestone {

/// @throws Bad_argument  the ray is not as `Ray` says
void check(const Ray& ray);

/// A face that the ray meets, and bounds on the depth of their first common point.
struct Hit_on_ray {
  std::uint32_t face;
  Triangle triangle;
  double low, high;
  std::optional<Exact_depth> exact = {};

  const Exact_depth& exact_depth_on(const Ray_frame& frame) {
    if (!exact) exact = exact_depth(frame, triangle);
    return *exact;
  }
};

/// By depth, then by index. Exact numbers are needed only where the bounds overlap.
bool is_before(const Ray_frame& frame, Hit_on_ray& a, Hit_on_ray& b);

/// The first of all hits, or none.
class First_hit {
 public:
  explicit First_hit(const Ray_frame& frame) : frame_(frame) {}

  /// Faces that are surely beyond this depth are of no use.
  double most_depth() const { return best_ ? best_->high : frame_.most_limit; }
  void add(Hit_on_ray hit) {
    if (!best_ || is_before(frame_, hit, *best_)) best_ = std::move(hit);
  }
  std::optional<Ray_hit> result();
  /// The same without a Ray_tree.
  static std::optional<Ray_hit> ask(const Layout_view& surface, const Ray& ray) { return first_hit(surface, ray); }

 private:
  const Ray_frame& frame_;
  std::optional<Hit_on_ray> best_;
};

/// All hits, sorted.
class Every_hit {
 public:
  explicit Every_hit(const Ray_frame& frame) : frame_(frame) {}

  double most_depth() const { return frame_.most_limit; }
  void add(Hit_on_ray hit) { hits_.push_back(std::move(hit)); }
  std::vector<Ray_hit> result();
  /// The same without a Ray_tree.
  static std::vector<Ray_hit> ask(const Layout_view& surface, const Ray& ray) { return all_hits(surface, ray); }

 private:
  const Ray_frame& frame_;
  std::vector<Hit_on_ray> hits_;
};

/// Adds a face to a collector if the ray meets it.
template <class Collector>
void test_face(const Ray_frame& frame, const Triangle_corners& corners, std::uint32_t face, Collector& collector) {
  const Depth_estimate estimate = estimate_depth(frame, corners);
  if (estimate.meets == Depth_estimate::Meets::no || estimate.low > collector.most_depth()) return;
  Hit_on_ray hit{face, triangle_of(corners), estimate.low, estimate.high};
  if (estimate.meets == Depth_estimate::Meets::unsure) {
    hit.exact = exact_depth(frame, hit.triangle);
    if (!hit.exact) return;
  }
  collector.add(std::move(hit));
}

}  // namespace lodestone
