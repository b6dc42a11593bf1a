// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/queries/ray_search.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <boost/container/small_vector.hpp>

#include "lodestone/queries/leaf_triangle.h"
#include "lodestone/queries/surface_on_demand.h"
#include "queries/box_entry.h"
#include "queries/ray_hits.h"
#include "queries/ray_leaf_kernel.h"

namespace lodestone {

namespace {

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
    const Ray_entry root = entry_(surface_.box(0));
    waiting_[0] = {0, root.depth};
    count_ = root.is_hit_within(Box_entry::largest);
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
    const Ray_entry entries[]{entry_(surface_.box(first)), entry_(surface_.box(second))};
    if (count_ + 2 > waiting_.size()) waiting_.resize(2 * waiting_.size(), boost::container::default_init);
    const double most = std::min(collector_.most_depth(), Box_entry::largest);
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
    const double error = frame_error(kernel::reach(box, input_.origin));
    const std::size_t count = kernel::list_ray_candidates(leaf, input_, error, collector_.most_depth(), candidates);
    for (std::size_t i = 0; i < count; ++i)
      tests_.add(frame_, leaf_triangle(leaf, candidates[i]), surface_.layout().faces(index)[candidates[i]], collector_);
    tests_.finish();
  }

  Surface& surface_;
  const Ray_frame& frame_;
  Box_entry entry_;
  Collector& collector_;
  Face_tests<Collector> tests_;
  kernel::Ray_input input_;
  boost::container::small_vector<Node_ahead, 64> waiting_;  ///< the first `count_`, the next one last
  std::size_t count_ = 0;
};

template <class Collector, Surface_on_demand Surface>
auto find(Surface& surface, const Ray& ray) {
  check(ray);
  const Ray_frame frame(ray.origin, ray.direction, ray.length);
  return ask_until_settled(
      [&] {
        Collector collector(frame);
        Ray_search(surface, frame, collector).run();
        return collector.result();
      },
      surface);
}

}  // namespace

std::optional<Ray_hit> first_hit(const Layout_view& surface, const Ray& ray) {
  Fitted_surface fitted(surface);
  return find<First_hit>(fitted, ray);
}

std::optional<Ray_hit> first_hit(Bounded_surface& surface, const Ray& ray) { return find<First_hit>(surface, ray); }

std::vector<Ray_hit> all_hits(const Layout_view& surface, const Ray& ray) {
  Fitted_surface fitted(surface);
  return find<Every_hit>(fitted, ray);
}

std::vector<Ray_hit> all_hits(Bounded_surface& surface, const Ray& ray) { return find<Every_hit>(surface, ray); }

}  // namespace lodestone
