// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/object_hits.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "queries/box_entry.h"
#include "queries/ray_hits.h"

namespace lodestone {

namespace {

/// Beyond the largest error of `Ray_hit::t`, relative.
constexpr double most_error = 0x1p-28;

/// Whether this `t` has no larger error.
bool is_precise(double t) { return t > 0x1p-1000 && t < 0x1p+1000; }

}  // namespace

/// A ray, as far as it can meet something first.
class First_of_objects::Way {
 public:
  /// @throws Bad_argument  the ray is not as `Ray` says
  explicit Way(const Ray& ray) : Way(ray, checked_frame(ray)) {}

  const Ray& ray() const { return ray_; }
  bool may_reach(const Aabb& box) const { return entry_(box).is_hit_within(most_depth_) != 0; }
  void end_at(double t) {
    if (!is_precise(t)) return;
    ray_.length = std::min(ray_.length, (1 + most_error) * t);
    most_depth_ = checked_frame(ray_).most_limit;
  }

 private:
  Way(const Ray& ray, const Ray_frame& frame) : ray_(ray), entry_(frame), most_depth_(frame.most_limit) {}

  static Ray_frame checked_frame(const Ray& ray) {
    check(ray);
    return {ray.origin, ray.direction, ray.length};
  }

  Ray ray_;
  Box_entry entry_;
  double most_depth_;
};

First_of_objects::First_of_objects(std::span<const Ray> rays, Triangle_of triangle_of)
    : triangle_of_(std::move(triangle_of)), ways_(rays.begin(), rays.end()), found_(rays.size()) {}

First_of_objects::~First_of_objects() = default;

std::span<const Ray> First_of_objects::rays_to(const Aabb& box) {
  asked_.clear();
  asked_indices_.clear();
  for (std::size_t i = 0; i < ways_.size(); ++i) {
    if (!ways_[i].may_reach(box)) continue;
    asked_.push_back(ways_[i].ray());
    asked_indices_.push_back(i);
  }
  return asked_;
}

void First_of_objects::take(Object_id object, std::span<const std::optional<Ray_hit>> hits) {
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const std::size_t ray = asked_indices_[i];
    if (!hits[i] || !is_earlier(ray, object, *hits[i])) continue;
    found_[ray] = {object, *hits[i]};
    ways_[ray].end_at(hits[i]->t);
  }
}

/// Doubles tell most; exact numbers, which is earlier of two that are nearly the same.
bool First_of_objects::is_earlier(std::size_t ray, Object_id object, const Ray_hit& hit) const {
  if (!found_[ray]) return true;
  const auto& [other, other_hit] = *found_[ray];
  const double t = hit.t, other_t = other_hit.t;
  if (is_precise(t) && is_precise(other_t) && std::abs(t - other_t) > most_error * other_t) return t < other_t;
  return meets_before(ways_[ray].ray(), triangle_of_(object, hit.face), triangle_of_(other, other_hit.face));
}

}  // namespace lodestone
