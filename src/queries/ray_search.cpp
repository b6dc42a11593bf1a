// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/ray_search.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <utility>

#include "lodestone/mesh/errors.h"
#include "lodestone/queries/leaf_triangle.h"
#include "lodestone/queries/surface_on_demand.h"
#include "queries/ray_leaf_kernel.h"
#include "triangles/ray_depth.h"

namespace lodestone {

namespace {

constexpr double largest = std::numeric_limits<double>::max();

void check(const Ray& ray) {
  if (!ray.origin.allFinite()) throw Bad_argument("the origin of a ray has a coordinate that is not finite");
  if (!ray.direction.allFinite() || ray.direction.isZero(0))
    throw Bad_argument("the direction of a ray must be finite and not zero");
  if (!(ray.length >= 0)) throw Bad_argument("the length of a ray must be 0 or more");
}

/// Where a ray enters a box.
struct Entry {
  double depth;  ///< a lower bound on it
  bool is_hit;   ///< false: the ray is proven to miss the box, and `depth` means nothing

  /// Whether the ray may be in the box at a depth. Without branches, since which boxes are hit is unpredictable.
  std::size_t is_hit_within(double most_depth) const {
    return static_cast<std::size_t>(is_hit) & static_cast<std::size_t>(depth <= most_depth);
  }
};

/// Tells where a ray enters boxes, by the slabs between their sides \cite kay1986.
///
/// A depth is a difference times the inverse of a slope, each rounded once, and so is their product: three roundings
/// in all. Eight are allowed for.
class Box_entry {
 public:
  explicit Box_entry(const Ray_frame& frame) : frame_(frame) {
    const double d_z = std::abs(frame.direction[frame.axes[2]]);
    for (int axis = 0; axis < 3; ++axis) {
      inverse_[axis] = d_z / frame.direction[axis];
      near_side_[axis] = inverse_[axis] >= 0 ? axis : high + axis;
      far_side_[axis] = inverse_[axis] >= 0 ? high + axis : axis;
      is_steep_ |= !std::isfinite(inverse_[axis]);
    }
  }

  [[gnu::always_inline]] Entry operator()(const Aabb& box) const {
    if (is_steep_) return with_steep_axes(box);
    const auto* const sides = reinterpret_cast<const double*>(&box);
    double enter = 0, leave = largest;
    for (int axis = 0; axis < 3; ++axis) {
      const double first = (sides[near_side_[axis]] - frame_.origin[axis]) * inverse_[axis];
      const double last = (sides[far_side_[axis]] - frame_.origin[axis]) * inverse_[axis];
      enter = first > enter ? first : enter;
      leave = last < leave ? last : leave;
    }
    return bound(enter, leave);
  }

 private:
  static constexpr double roundings = 0x1p-49, underflow = 0x1p-1000;
  static constexpr int high = 4;  ///< where the high sides of a box begin
  static_assert(sizeof(Aabb) == 2 * high * sizeof(double));

  static Entry bound(double enter, double leave) {
    const double entered = enter < largest ? enter : largest;
    return {entered * (1 - roundings), entered <= leave * (1 + roundings) + underflow};
  }

  [[gnu::noinline]] Entry with_steep_axes(const Aabb& box) const {
    const auto* const sides = reinterpret_cast<const double*>(&box);
    double enter = 0, leave = largest;
    for (int axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(inverse_[axis])) {
        if (is_beside(box, axis)) return {0, false};
        continue;
      }
      enter = std::max(enter, (sides[near_side_[axis]] - frame_.origin[axis]) * inverse_[axis]);
      leave = std::min(leave, (sides[far_side_[axis]] - frame_.origin[axis]) * inverse_[axis]);
    }
    return bound(enter, leave);
  }

  /// Whether a ray that is orthogonal to an axis misses a box.
  bool is_beside(const Aabb& box, int axis) const {
    return frame_.direction[axis] == 0 && (frame_.origin[axis] < box.low[axis] || frame_.origin[axis] > box.high[axis]);
  }

  const Ray_frame& frame_;
  std::array<double, 3> inverse_;  ///< change of depth along each axis
  std::array<int, 3> near_side_;   ///< by which the ray enters: indices of numbers of a box
  std::array<int, 3> far_side_;    ///< by which it leaves
  bool is_steep_ = false;          ///< some inverse is infinite
};

/// A face that the ray meets, and bounds on the depth of their first common point.
struct Hit {
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
bool is_before(const Ray_frame& frame, Hit& a, Hit& b) {
  if (a.high < b.low) return true;
  if (b.high < a.low) return false;
  const auto order = CGAL::compare(a.exact_depth_on(frame), b.exact_depth_on(frame));
  return order != CGAL::EQUAL ? order == CGAL::SMALLER : a.face < b.face;
}

/// Without exact() a lazy number converts to the midpoint of its interval, which may be off in the last digits.
double rounded(const Exact_depth& x) {
  x.exact();
  return CGAL::to_double(x);
}

Ray_hit rounded(const Ray_frame& frame, Hit& hit) {
  const double d_z = std::abs(frame.direction[frame.axes[2]]);
  const bool is_precise = hit.high - hit.low <= 0x1p-32 * hit.low && hit.low > 0x1p-1000;
  const double depth = is_precise ? hit.low / 2 + hit.high / 2 : rounded(hit.exact_depth_on(frame));
  Ray_hit result{.face = hit.face};
  result.t = is_precise ? depth / d_z : rounded(hit.exact_depth_on(frame) / Exact_depth(d_z));
  result.t += 0.0;  // no negative zero
  for (int axis = 0; axis < 3; ++axis) result.point[axis] = frame.origin[axis] + depth * (frame.direction[axis] / d_z);
  return result;
}

/// Keeps the first of all hits.
struct First_hit {
  const Ray_frame& frame;
  std::optional<Hit> best = {};

  /// Faces that are surely beyond this depth are of no use.
  double most_depth() const { return best ? best->high : frame.most_limit; }
  void add(Hit hit) {
    if (!best || is_before(frame, hit, *best)) best = std::move(hit);
  }
};

struct Every_hit {
  const Ray_frame& frame;
  std::vector<Hit> hits = {};

  double most_depth() const { return frame.most_limit; }
  void add(Hit hit) { hits.push_back(std::move(hit)); }
};

/// Shows a collector the faces that a ray meets, leaf by leaf, from front to back as far as boxes tell.
template <Surface_on_demand Surface, class Collector>
class Ray_search {
 public:
  Ray_search(Surface& surface, const Ray_frame& frame, Collector& collector)
      : surface_(surface), frame_(frame), entry_(frame), collector_(collector) {
    for (int axis = 0; axis < 3; ++axis) input_.origin[axis] = frame.origin[axis];
    for (int i = 0; i < 2; ++i) input_.shear[frame.axes[i]] = frame.shear[i];
    input_.shear[frame.axes[2]] = 0;
    input_.sign = frame.sign;
    input_.depth_axis = frame.axes[2];
  }

  /// Ends early, with some faces missing, once the surface is broken.
  void run() {
    const Tree_layout& tree = surface_.layout();
    waiting_.resize(64, boost::container::default_init);
    const Entry root = entry_(surface_.box(0));
    waiting_[0] = {0, root.depth};
    count_ = root.is_hit_within(largest);
    while (count_ > 0 && !surface_.is_broken()) {
      const Node_ahead next = waiting_[--count_];
      if (next.depth > collector_.most_depth()) continue;
      if (const auto& node = tree.node(next.node); node.second_child == 0)
        visit(node.leaf);
      else
        open(next.node + 1, node.second_child);
    }
  }

 private:
  /// A node, and a lower bound on the depth at which the ray enters its box.
  struct Node_ahead {
    std::uint32_t node;
    double depth;
  };

  /// Pushes the children that the ray meets, the one that it enters first last. Which they are is unpredictable, so
  /// both are written.
  void open(std::uint32_t first, std::uint32_t second) {
    prefetch_below(first);
    prefetch_below(second);
    const Entry entries[]{entry_(surface_.box(first)), entry_(surface_.box(second))};
    if (count_ + 2 > waiting_.size()) waiting_.resize(2 * waiting_.size(), boost::container::default_init);
    const double most = std::min(collector_.most_depth(), largest);
    const std::uint32_t nodes[]{first, second};
    const std::size_t nearer = entries[1].depth < entries[0].depth ? 1 : 0;
    for (const std::size_t child : {1 - nearer, nearer}) {
      waiting_[count_] = {nodes[child], entries[child].depth};
      count_ += entries[child].is_hit_within(most);
    }
  }

  /// What is read next if the ray meets the box of a node.
  void prefetch_below(std::uint32_t n) const {
    const auto& node = surface_.layout().node(n);
    if (node.second_child != 0) {
      hwy::Prefetch(&surface_.layout().node(node.second_child));
      hwy::Prefetch(surface_.view().boxes.data() + node.second_child);
    }
  }

  void visit(std::uint32_t index) {
    const Aabb& box = surface_.pose(index);
    if (surface_.is_broken()) return;
    // A fitted box can be smaller than the bound that led here.
    if (!std::same_as<Surface, Fitted_surface> && entry_(box).is_hit_within(collector_.most_depth()) == 0) return;
    const Leaf_faces leaf = surface_.view().leaf(index);
    std::uint8_t candidates[most_leaf_faces];
    const std::size_t count =
        kernel::list_ray_candidates(leaf, input_, frame_error(reach(box)), collector_.most_depth(), candidates);
    for (std::size_t i = 0; i < count; ++i)
      test(leaf_triangle(leaf, candidates[i]), surface_.layout().faces(index)[candidates[i]]);
  }

  void test(const Triangle_corners& corners, std::uint32_t face) {
    const Depth_estimate estimate = estimate_depth(frame_, corners);
    if (estimate.meets == Depth_estimate::Meets::no || estimate.low > collector_.most_depth()) return;
    Hit hit{face, triangle_of(corners), estimate.low, estimate.high};
    if (estimate.meets == Depth_estimate::Meets::unsure) {
      hit.exact = exact_depth(frame_, hit.triangle);
      if (!hit.exact) return;
    }
    collector_.add(std::move(hit));
  }

  /// The largest coordinate of a point of a box, as seen from the origin.
  double reach(const Aabb& box) const {
    double most = 0;
    for (int axis = 0; axis < 3; ++axis)
      most = std::max(
          {most, std::abs(box.low[axis] - frame_.origin[axis]), std::abs(box.high[axis] - frame_.origin[axis])});
    return most;
  }

  Surface& surface_;
  const Ray_frame& frame_;
  Box_entry entry_;
  Collector& collector_;
  kernel::Ray_input input_;
  boost::container::small_vector<Node_ahead, 64> waiting_;  ///< the first `count_`, the next one last
  std::size_t count_ = 0;
};

template <Surface_on_demand Surface>
std::optional<Ray_hit> find_first(Surface& surface, const Ray& ray) {
  check(ray);
  const Ray_frame frame(ray.origin, ray.direction, ray.length);
  return ask_until_settled(
      [&]() -> std::optional<Ray_hit> {
        First_hit first{frame};
        Ray_search(surface, frame, first).run();
        return first.best ? std::optional(rounded(frame, *first.best)) : std::nullopt;
      },
      surface);
}

template <Surface_on_demand Surface>
std::vector<Ray_hit> find_all(Surface& surface, const Ray& ray) {
  check(ray);
  const Ray_frame frame(ray.origin, ray.direction, ray.length);
  return ask_until_settled(
      [&] {
        Every_hit every{frame};
        Ray_search(surface, frame, every).run();
        std::ranges::sort(every.hits, [&](Hit& a, Hit& b) { return is_before(frame, a, b); });
        std::vector<Ray_hit> hits;
        for (Hit& hit : every.hits) hits.push_back(rounded(frame, hit));
        return hits;
      },
      surface);
}

}  // namespace

std::optional<Ray_hit> first_hit(const Layout_view& surface, const Ray& ray) {
  Fitted_surface fitted(surface);
  return find_first(fitted, ray);
}

std::optional<Ray_hit> first_hit(Bounded_surface& surface, const Ray& ray) { return find_first(surface, ray); }

std::vector<Ray_hit> all_hits(const Layout_view& surface, const Ray& ray) {
  Fitted_surface fitted(surface);
  return find_all(fitted, ray);
}

std::vector<Ray_hit> all_hits(Bounded_surface& surface, const Ray& ray) { return find_all(surface, ray); }

}  // namespace lodestone
