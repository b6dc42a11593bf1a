// SPDX-License-Identifier: GPL-3.0-or-later
#include "queries/ray_walk_kernel.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "queries/ray_walk_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The children of a node or the faces of a block, or as many of them as a vector holds.
using Lanes = hn::CappedTag<float, ray_tree_width>;
using Lane_values = hn::Vec<Lanes>;
constexpr std::size_t step = hn::MaxLanes(Lanes());

HWY_INLINE Lane_values greatest(Lane_values a, Lane_values b, Lane_values c) { return hn::Max(hn::Max(a, b), c); }
HWY_INLINE Lane_values least(Lane_values a, Lane_values b, Lane_values c) { return hn::Min(hn::Min(a, b), c); }

/// Finds the children of a node that the ray may meet, by the slabs between their sides \cite kay1986.
/// @param depths  of the boxes' nearest points, per child
/// @return a bit per child
HWY_INLINE std::uint32_t meet_children(const Ray_node& node, const Ray_walk& ray, float most, float* depths) {
  const Lanes d;
  const float* const sides = node.sides[0][0];
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < ray_tree_width; i += step) {
    const auto enter = [&](int axis) HWY_ATTR {
      return hn::MulSub(hn::Load(d, sides + ray.near_side[axis] + i), hn::Set(d, ray.inverse[axis]),
                        hn::Set(d, ray.enter[axis]));
    };
    const auto leave = [&](int axis) HWY_ATTR {
      return hn::MulSub(hn::Load(d, sides + ray.far_side[axis] + i), hn::Set(d, ray.inverse[axis]),
                        hn::Set(d, ray.leave[axis]));
    };
    const Lane_values first = hn::Max(hn::Max(enter(0), hn::Zero(d)), hn::Max(enter(1), enter(2)));
    const Lane_values last = hn::Min(hn::Min(leave(0), hn::Set(d, most)), hn::Min(leave(1), leave(2)));
    hn::Store(first, d, depths + i);
    bits |= mask_bits(d, hn::Le(first, last)) << i;
  }
  return bits;
}

/// The corners of some faces, as seen along the ray.
struct Seen_corners {
  Lane_values x[3], y[3], depth[3];
};

HWY_INLINE Seen_corners see_corners(const Ray_block& block, const Ray_walk& ray, std::size_t first) {
  const auto [x_axis, y_axis, depth_axis] = ray.axes;
  const Lanes d;
  const Lane_values sign = hn::Set(d, ray.slope[depth_axis]), start = hn::Set(d, ray.start);
  const Lane_values slope_x = hn::Set(d, ray.slope[x_axis]), slope_y = hn::Set(d, ray.slope[y_axis]);
  const Lane_values across_x = hn::Set(d, ray.across[x_axis]), across_y = hn::Set(d, ray.across[y_axis]);
  Seen_corners seen;
  for (int c = 0; c < 3; ++c) {
    const Lane_values z = hn::Mul(sign, hn::Load(d, block.corners[c][depth_axis] + first));
    seen.x[c] = hn::Sub(hn::NegMulAdd(slope_x, z, hn::Load(d, block.corners[c][x_axis] + first)), across_x);
    seen.y[c] = hn::Sub(hn::NegMulAdd(slope_y, z, hn::Load(d, block.corners[c][y_axis] + first)), across_y);
    seen.depth[c] = hn::Sub(z, start);
  }
  return seen;
}

/// The faces that the ray passes with edges on different sides. See `estimate_depth` for the error of a weight.
HWY_INLINE hn::Mask<Lanes> pass_beside(const Seen_corners& seen) {
  const Lanes d;
  const auto &x = seen.x, &y = seen.y;
  Lane_values size = hn::Zero(d);
  for (int c = 0; c < 3; ++c) size = greatest(size, hn::Abs(x[c]), hn::Abs(y[c]));
  const Lane_values error = hn::Mul(hn::Set(d, 8 * walk_error), hn::Add(size, hn::Set(d, walk_error)));
  const Lane_values weight_0 = hn::Sub(hn::Mul(x[1], y[2]), hn::Mul(x[2], y[1]));
  const Lane_values weight_1 = hn::Sub(hn::Mul(x[2], y[0]), hn::Mul(x[0], y[2]));
  const Lane_values weight_2 = hn::Sub(hn::Mul(x[0], y[1]), hn::Mul(x[1], y[0]));
  return hn::And(hn::Lt(least(weight_0, weight_1, weight_2), hn::Neg(error)),
                 hn::Gt(greatest(weight_0, weight_1, weight_2), error));
}

/// The faces with all corners behind the start of the ray, or too deep.
HWY_INLINE hn::Mask<Lanes> out_of_reach(const Seen_corners& seen, float most) {
  const Lanes d;
  const auto& depth = seen.depth;
  return hn::Or(hn::Lt(greatest(depth[0], depth[1], depth[2]), hn::Set(d, -walk_error)),
                hn::Gt(least(depth[0], depth[1], depth[2]), hn::Set(d, most + walk_error)));
}

/// @return a bit per face that the ray may meet
HWY_INLINE std::uint32_t meet_faces(const Ray_block& block, const Ray_walk& ray, float most) {
  std::uint32_t missed = 0;
  for (std::size_t i = 0; i < ray_tree_width; i += step) {
    const Seen_corners seen = see_corners(block, ray, i);
    missed |= mask_bits(Lanes(), hn::Or(pass_beside(seen), out_of_reach(seen, most))) << i;
  }
  return ~missed & ((1U << block.count) - 1);
}

/// A child that waits, as one number: those that the ray enters later are greater, since depths are not negative.
HWY_INLINE std::uint64_t waiting_child(float depth, std::uint32_t child) {
  return std::uint64_t{std::bit_cast<std::uint32_t>(depth)} << 32 | child;
}
HWY_INLINE float depth_of(std::uint64_t waiting) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(waiting >> 32));
}

/// Has the first half of a child read from memory, meanwhile; reading it brings the rest.
HWY_INLINE void prefetch(const Ray_nodes& tree, std::uint64_t waiting) {
  const auto child = static_cast<std::uint32_t>(waiting);
  const void* const begin = (child & is_ray_block) != 0
                                ? static_cast<const void*>(tree.blocks + (child & ~is_ray_block))
                                : static_cast<const void*>(tree.nodes + child);
  constexpr std::size_t line = 64;
  for (std::size_t i = 0; i < sizeof(Ray_node); i += line) hwy::Prefetch(static_cast<const char*>(begin) + i);
}

/// Goes on to the nearest of the children whose bits are set; the others wait. They are not sorted, since the order is
/// unpredictable, and matters little.
/// @param bits  at least one
HWY_INLINE void go_to_nearest(const Ray_nodes& tree, const Ray_node& node, std::uint32_t bits, const float* depths,
                              Ray_walker& walker) {
  const auto child = [&](std::uint32_t set) {
    const auto i = static_cast<std::size_t>(std::countr_zero(set));
    return waiting_child(depths[i], node.children[i]);
  };
  std::uint64_t nearest = child(bits);
  while ((bits &= bits - 1) != 0) {
    const std::uint64_t other = child(bits), farther = std::max(nearest, other);
    prefetch(tree, farther);
    *walker.end_waiting++ = farther;
    nearest = std::min(nearest, other);
  }
  prefetch(tree, nearest);
  walker.next = nearest;
}

/// Goes back to what was left to wait last and is not too deep by now.
/// @return false if there is nothing
HWY_INLINE bool go_back(Ray_walker& walker) {
  do {
    if (walker.end_waiting == walker.waiting) return false;
    walker.next = *--walker.end_waiting;
  } while (depth_of(walker.next) > walker.most);
  return true;
}

/// Visits one node or block.
/// @return false: the walk has ended
HWY_INLINE bool advance(const Ray_nodes& tree, Ray_walker& walker, Ray_visitor& visitor) {
  const auto child = static_cast<std::uint32_t>(walker.next);
  if ((child & is_ray_block) == 0) {
    const Ray_node& node = tree.nodes[child];
    alignas(64) float depths[ray_tree_width];
    if (const std::uint32_t bits = meet_children(node, walker.ray, walker.most, depths); bits != 0) {
      go_to_nearest(tree, node, bits, depths, walker);
      return true;
    }
  } else {
    const Ray_block& block = tree.blocks[child & ~is_ray_block];
    for (std::uint32_t bits = meet_faces(block, walker.ray, walker.most); bits != 0; bits &= bits - 1)
      walker.most = visitor.visit(walker, block, static_cast<std::size_t>(std::countr_zero(bits)));
  }
  return go_back(walker);
}

void walk_rays_kernel(const Ray_nodes& tree, Ray_walker* const* walkers, std::size_t count, Ray_visitor& visitor) {
  Ray_walker* walking[most_ray_walkers];
  std::copy_n(walkers, count, walking);
  while (count > 0)
    for (std::size_t i = 0; i < count;) {
      Ray_walker& walker = *walking[i];
      if (advance(tree, walker, visitor) || visitor.end(walker))
        ++i;
      else
        walking[i] = walking[--count];
    }
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(walk_rays_kernel);

void walk_rays(const Ray_nodes& tree, std::span<Ray_walker* const> walkers, Ray_visitor& visitor) {
  HWY_DYNAMIC_DISPATCH(walk_rays_kernel)(tree, walkers.data(), walkers.size(), visitor);
}

}  // namespace lodestone::kernel
#endif
