// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/object_hits.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "lodestone/queries/ask_each.h"
#include "queries/box_entry.h"

namespace lodestone {

namespace {

/// Beyond the largest error of `Ray_hit::t`, relative.
constexpr double most_error = 0x1p-28;

/// Whether this `t` has no larger error.
bool is_precise(double t) { return t > 0x1p-1000 && t < 0x1p+1000; }

/// A ray, as far as it can meet something first.
class Shortened_ray {
 public:
  /// @param ray  has been checked
  explicit Shortened_ray(const Ray& ray) : Shortened_ray(ray, {ray.origin, ray.direction, ray.length}) {}

  const Ray& ray() const { return ray_; }
  Ray_entry entry(const Aabb& box) const { return entry_(box); }
  double most_depth() const { return most_depth_; }
  void end_at(double t) {
    if (!is_precise(t)) return;
    const double most = (1 + most_error) * t;
    ray_.length = std::min(ray_.length, most);
    // By more than what is rounded, or underflows.
    most_depth_ = std::min(most_depth_, (1 + most_error) * most * depth_per_t_ + 0x1p-1000);
  }

 private:
  Shortened_ray(const Ray& ray, const Ray_frame& frame)
      : ray_(ray),
        entry_(frame),
        most_depth_(frame.most_limit),
        depth_per_t_(std::abs(frame.direction[frame.axes[2]])) {}

  Ray ray_;
  Box_entry entry_;
  double most_depth_, depth_per_t_;
};

class Search_among_objects {
 public:
  Search_among_objects(std::span<const Ray> rays, std::span<const Boxed_object> objects, const Ask_object& ask,
                       const Face_of_object& triangle_of)
      : objects_(objects), ask_(ask), triangle_of_(triangle_of), rays_(rays.begin(), rays.end()), found_(rays.size()) {}

  std::vector<std::optional<Object_hit>> run() {
    if (objects_.empty()) return std::move(found_);
    std::vector<std::uint32_t> all(objects_.size());
    std::iota(all.begin(), all.end(), 0U);
    std::vector<Ray_ahead> rays;
    const Aabb box = box_around(all);
    for (std::uint32_t i = 0; i < rays_.size(); ++i) add_if_near(i, rays_[i].entry(box), rays);
    visit(all, rays);
    return std::move(found_);
  }

 private:
  /// A ray, and a lower bound on the depth at which it enters a box.
  struct Ray_ahead {
    std::uint32_t ray;
    double depth;
  };

  Aabb box_around(std::span<const std::uint32_t> objects) const {
    Aabb box = objects_[objects.front()].box;
    for (const auto object : objects) box.enclose(box, objects_[object].box);
    return box;
  }

  /// Moves the objects below the median, along the longest side of their box, to the front.
  /// @return how many these are
  std::size_t halve(std::span<std::uint32_t> objects) const {
    const Aabb box = box_around(objects);
    int axis = 0;
    for (int other = 1; other < 3; ++other)
      if (box.high[other] - box.low[other] > box.high[axis] - box.low[axis]) axis = other;
    const auto key = [&](std::uint32_t object) {
      const Aabb& own = objects_[object].box;
      return std::pair(own.low[axis] / 2 + own.high[axis] / 2, object);
    };
    const std::size_t half = objects.size() / 2;
    std::ranges::nth_element(objects, objects.begin() + static_cast<std::ptrdiff_t>(half), {}, key);
    return half;
  }

  void add_if_near(std::uint32_t ray, const Ray_entry& entry, std::vector<Ray_ahead>& rays) const {
    if (entry.is_hit_within(rays_[ray].most_depth()) != 0) rays.push_back({ray, entry.depth});
  }

  /// @param objects  by their places in the list of all; their order is lost
  /// @param rays     that reach the box around them, unless they have met something before
  void visit(std::span<std::uint32_t> objects, std::vector<Ray_ahead>& rays) {
    std::erase_if(rays, [this](const Ray_ahead& ahead) { return ahead.depth > rays_[ahead.ray].most_depth(); });
    if (rays.empty()) return;
    if (objects.size() == 1) return ask(objects_[objects.front()].id, rays);
    const std::size_t half = halve(objects);
    const std::span<std::uint32_t> halves[]{objects.first(half), objects.subspan(half)};
    const Aabb boxes[]{box_around(halves[0]), box_around(halves[1])};
    std::vector<Ray_ahead> below[2];
    std::ptrdiff_t second_sooner = 0;
    for (const Ray_ahead& ahead : rays) {
      const Ray_entry entries[]{rays_[ahead.ray].entry(boxes[0]), rays_[ahead.ray].entry(boxes[1])};
      for (std::size_t i = 0; i < 2; ++i) add_if_near(ahead.ray, entries[i], below[i]);
      if (entries[0].is_hit && entries[1].is_hit) second_sooner += entries[1].depth < entries[0].depth ? 1 : -1;
    }
    const std::size_t first = second_sooner > 0 ? 1 : 0;
    for (const std::size_t i : {first, 1 - first}) visit(halves[i], below[i]);
  }

  void ask(Object_id object, std::span<const Ray_ahead> rays) {
    asked_.clear();
    for (const Ray_ahead& ahead : rays) asked_.push_back(rays_[ahead.ray].ray());
    const auto hits = ask_(object, asked_);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const std::uint32_t ray = rays[i].ray;
      if (!hits[i] || !is_earlier(ray, {object, *hits[i]})) continue;
      found_[ray] = {object, *hits[i]};
      rays_[ray].end_at(hits[i]->t);
    }
  }

  /// Doubles tell most; exact numbers, which is earlier of two that are nearly the same.
  bool is_earlier(std::uint32_t ray, const Object_hit& hit) const {
    if (!found_[ray]) return true;
    const Object_hit& other = *found_[ray];
    const double t = hit.hit.t, other_t = other.hit.t;
    if (is_precise(t) && is_precise(other_t) && std::abs(t - other_t) > most_error * other_t) return t < other_t;
    const Triangle triangle = triangle_of_(hit.object, hit.hit.face),
                   other_triangle = triangle_of_(other.object, other.hit.face);
    const Ray& whole = rays_[ray].ray();
    return hit.object < other.object ? !meets_before(whole, other_triangle, triangle)
                                     : meets_before(whole, triangle, other_triangle);
  }

  std::span<const Boxed_object> objects_;
  const Ask_object& ask_;
  const Face_of_object& triangle_of_;
  std::vector<Shortened_ray> rays_;
  std::vector<std::optional<Object_hit>> found_;
  std::vector<Ray> asked_;
};

}  // namespace

std::vector<std::optional<Object_hit>> first_hits_among(std::span<const Ray> rays,
                                                        std::span<const Boxed_object> objects, const Ask_object& ask,
                                                        const Face_of_object& triangle_of) {
  check_each(rays);
  return Search_among_objects(rays, objects, ask, triangle_of).run();
}

}  // namespace lodestone
