// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lodestone/queries/ray_search.h"
#include "queries/ray_walk_kernel.h"
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
  static constexpr auto until = kernel::Walk_until::first_hit;

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
  static constexpr auto until = kernel::Walk_until::end;

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

/// Tests faces against rays, some at once, and adds those that a ray meets to its collector.
template <class Collector>
class Face_tests {
 public:
  /// @param frame, collector  of the ray; must stay until `finish`, as the corners
  void add(const Ray_frame& frame, const Triangle_corners& corners, std::uint32_t face, Collector& collector) {
    ask(frame, corners, questions_, count_);
    tests_[count_] = {&frame, corners, face, &collector};
    if (++count_ == kernel::most_depth_questions) finish();
  }

  /// Tests those that are left.
  void finish() {
    if (count_ == 0) return;
    kernel::Depth_estimates estimates;
    kernel::estimate_depths(questions_, count_, estimates);
    for (std::size_t i = 0; i < count_; ++i)
      if ((estimates.misses >> i & 1U) == 0)
        collect(tests_[i], estimates.low[i], estimates.high[i], (estimates.meets >> i & 1U) != 0);
    count_ = 0;
  }

 private:
  struct Test {
    const Ray_frame* frame;
    Triangle_corners corners;
    std::uint32_t face;
    Collector* collector;
  };

  static void collect(const Test& test, double low, double high, bool surely_meets) {
    if (low > test.collector->most_depth()) return;
    Hit_on_ray hit{test.face, triangle_of(test.corners), low, high};
    if (!surely_meets) {
      hit.exact = exact_depth(*test.frame, hit.triangle);
      if (!hit.exact) return;
    }
    test.collector->add(std::move(hit));
  }

  kernel::Depth_questions questions_;
  Test tests_[kernel::most_depth_questions];
  std::size_t count_ = 0;
};

}  // namespace lodestone
