// SPDX-License-Identifier: GPL-3.0-or-later
#include "queries/ray_hits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "lodestone/mesh/errors.h"
#include "lodestone/queries/ask_each.h"
#include "mesh/is_finite.h"

namespace lodestone {

namespace {

Ray_hit rounded(const Ray_frame& frame, Hit_on_ray& hit) {
  const double d_z = std::abs(frame.direction[frame.axes[2]]);
  const bool is_precise = hit.high - hit.low <= 0x1p-32 * hit.low && hit.low > 0x1p-1000;
  const auto exactly_over = [&](double divisor) {
    return rounded_quotient(hit.exact_depth_on(frame), divisor, frame, hit.triangle);
  };
  const double depth = is_precise ? hit.low / 2 + hit.high / 2 : exactly_over(1);
  Ray_hit result{.face = hit.face};
  result.t = is_precise ? depth / d_z : exactly_over(d_z);
  result.t += 0.0;  // no negative zero
  for (int axis = 0; axis < 3; ++axis) result.point[axis] = frame.origin[axis] + depth * (frame.direction[axis] / d_z);
  if (!result.point.allFinite()) {  // the depth, or a sum on the way, exceeds the greatest double
    const double quarter = exactly_over(4);
    for (int axis = 0; axis < 3; ++axis)
      result.point[axis] = 4 * (frame.origin[axis] / 4 + quarter * (frame.direction[axis] / d_z));
    constexpr double greatest = std::numeric_limits<double>::max();
    result.point = result.point.cwiseMax(-greatest).cwiseMin(greatest);
  }
  return result;
}

}  // namespace

void check(const Ray& ray) {
  if (!ray.origin.allFinite()) throw Bad_argument("the origin of a ray has a coordinate that is not finite");
  if (!ray.direction.allFinite() || ray.direction.isZero(0))
    throw Bad_argument("the direction of a ray must be finite and not zero");
  if (!(ray.length >= 0)) throw Bad_argument("the length of a ray must be 0 or more");
}

void check_each(std::span<const Ray> rays) {
  for (std::size_t i = 0; i < rays.size(); ++i) try {
      check(rays[i]);
    } catch (const Bad_argument& error) {
      if (rays.size() == 1) throw;
      throw Bad_argument("ray " + std::to_string(i) + ": " + error.what());
    }
}

void check_each(std::span<const Point> points) {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!is_finite(points[i]))
      throw Bad_argument((points.size() == 1 ? "the point" : "point " + std::to_string(i) + ": the point") +
                         " has a coordinate that is not finite");
}

bool is_before(const Ray_frame& frame, Hit_on_ray& a, Hit_on_ray& b) {
  if (a.high < b.low) return true;
  if (b.high < a.low) return false;
  const auto order = CGAL::compare(a.exact_depth_on(frame), b.exact_depth_on(frame));
  return order != CGAL::EQUAL ? order == CGAL::SMALLER : a.face < b.face;
}

bool meets_before(const Ray& ray, const Triangle& a, const Triangle& b) {
  const Ray_frame frame(ray.origin, ray.direction, std::numeric_limits<double>::infinity());
  return CGAL::compare(exact_depth(frame, a).value(), exact_depth(frame, b).value()) == CGAL::SMALLER;
}

std::optional<Ray_hit> First_hit::result() { return best_ ? std::optional(rounded(frame_, *best_)) : std::nullopt; }

std::vector<Ray_hit> Every_hit::result() {
  std::ranges::sort(hits_, [&](Hit_on_ray& a, Hit_on_ray& b) { return is_before(frame_, a, b); });
  std::vector<Ray_hit> results;
  results.reserve(hits_.size());
  for (Hit_on_ray& hit : hits_) results.push_back(rounded(frame_, hit));
  return results;
}

}  // namespace lodestone
