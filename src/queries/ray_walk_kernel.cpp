// SPDX-License-Identifier: GPL-3.0-or-later
#include "queries/ray_walk_kernel.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <bit>
#include <boost/container/small_vector.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "queries/ray_walk_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/lane_lists.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The children of a node or the faces of a block, or as many of them as a vector holds.
using Lanes = hn::CappedTag<float, ray_tree_width>;
using Lane_values = hn::Vec<Lanes>;
constexpr std::size_t step = hn::MaxLanes(Lanes());

/// A child and the depth at which a ray enters it, as one number: children that are entered later are greater.
using Keys = hn::CappedTag<std::int64_t, ray_tree_width>;
constexpr std::size_t key_step = hn::MaxLanes(Keys());
constexpr std::int64_t end_of_walk = 0xffffffff;  ///< waits below all others, at depth 0
constexpr std::uint32_t missed_depth = 0x7fffffff;
constexpr std::int64_t missed_key = std::int64_t{missed_depth} << 32;  ///< no key of a child that is met is as great

HWY_INLINE std::uint32_t child_of(std::int64_t key) { return static_cast<std::uint32_t>(key); }

/// The least key that is deeper.
HWY_INLINE std::int64_t deeper_key(float depth) {
  return (std::int64_t{std::bit_cast<std::uint32_t>(std::max(0.0F, depth))} + 1) << 32;
}

/// A ray on its walk.
struct Walker {
  const Ray_walks* walks;  ///< it and its neighbours
  std::uint32_t lane;      ///< its place there
  std::uint32_t ray;       ///< its index
  float most;              ///< how deep it has to go
  std::int64_t next;       ///< what it visits next
  std::int64_t* bottom;    ///< what may have to be visited later, the end of the walk first
  std::int64_t* waiting;   ///< past the last of that
};

/// @param bottom  room for what waits
HWY_INLINE void start(Walker& walker, const Ray_walks* walks, std::uint32_t ray, std::int64_t* bottom) {
  walker.walks = walks + ray / ray_tree_width;
  walker.lane = ray % ray_tree_width;
  walker.ray = ray;
  walker.most = walker.walks->most[walker.lane];
  walker.next = 0;
  walker.bottom = walker.waiting = bottom;
  *walker.waiting++ = end_of_walk;
}

/// Where a ray enters the children of a node, by the slabs between their sides \cite kay1986.
/// @param depths  bits of the depths, per child; `missed_depth` where it misses
/// @return a bit per child that it meets
HWY_INLINE std::uint32_t enter_children(const Ray_node& node, const Walker& walker, std::uint32_t* depths) {
  const Ray_walks& walks = *walker.walks;
  const std::size_t ray = walker.lane;
  const Lanes d;
  const hn::RebindToUnsigned<Lanes> bits;
  const float* const sides = node.sides[0][0];
  std::uint32_t all_met = 0;
  for (std::size_t i = 0; i < ray_tree_width; i += step) {
    const auto enter = [&](int axis) HWY_ATTR {
      return hn::MulSub(hn::Load(d, sides + walks.near_side[axis][ray] + i), hn::Set(d, walks.inverse[axis][ray]),
                        hn::Set(d, walks.enter[axis][ray]));
    };
    const auto leave = [&](int axis) HWY_ATTR {
      return hn::MulSub(hn::Load(d, sides + walks.far_side[axis][ray] + i), hn::Set(d, walks.inverse[axis][ray]),
                        hn::Set(d, walks.leave[axis][ray]));
    };
    const Lane_values first = hn::Max(greatest(enter(0), enter(1), enter(2)), hn::Zero(d));
    const Lane_values last = hn::Min(least(leave(0), leave(1), leave(2)), hn::Set(d, walker.most));
    const auto is_met = hn::Le(first, last);
    const auto met = hn::RebindMask(bits, is_met);
    all_met |= mask_bits(d, is_met) << i;
    // A zero may have a sign.
    hn::Store(hn::IfThenElse(met, hn::BitCast(bits, hn::Abs(first)), hn::Set(bits, missed_depth)), bits, depths + i);
  }
  return all_met;
}

/// Stores the chosen keys next to each other. Writes a whole vector.
/// @return their number
HWY_INLINE std::size_t store_keys(hn::Vec<Keys> keys, hn::Mask<Keys> chosen, std::int64_t* to) {
  const Keys d;
  const std::uint32_t bits = mask_bits(d, chosen);
#if HWY_TARGET <= HWY_AVX3
  // Not `Compress`: GCC 12 copies a table of two kilobytes at each call of Highway's.
  hn::StoreU(hn::Vec<Keys>{_mm512_maskz_compress_epi64(chosen.raw, keys.raw)}, d, to);
#else
  alignas(64) std::int64_t all[key_step];
  hn::Store(keys, d, all);
  for (std::size_t i = 0; i < key_step; ++i) to[i] = all[lane_lists[bits][i] % key_step];
#endif
  return hwy::PopCount(bits);
}

/// Goes on to the nearest of the children that the ray meets; the others wait. They are not sorted, since that gains
/// nothing. If there is none, goes on to what was left to wait last. Without branches, since how many there are is
/// unpredictable.
HWY_INLINE void visit_node(const Ray_node& node, Walker& walker) {
  alignas(64) std::uint32_t depths[ray_tree_width];
  enter_children(node, walker, depths);
  const Keys d;
  const hn::RebindToUnsigned<Keys> u;
  const hn::Rebind<std::uint32_t, Keys> half;
  const auto key = [&](std::size_t i) HWY_ATTR {
    const auto depth = hn::PromoteTo(u, hn::Load(half, depths + i));
    const auto child = hn::PromoteTo(u, hn::Load(half, node.children + i));
    return hn::BitCast(d, hn::Or(hn::ShiftLeft<32>(depth), child));
  };
  auto nearest_keys = key(0);
  for (std::size_t i = key_step; i < ray_tree_width; i += key_step) nearest_keys = hn::Min(nearest_keys, key(i));
  const auto nearest = hn::MinOfLanes(d, nearest_keys);
  for (std::size_t i = 0; i < ray_tree_width; i += key_step) {
    const auto keys = key(i);
    const auto waits = hn::And(hn::Lt(keys, hn::Set(d, missed_key)), hn::Ne(keys, nearest));
    walker.waiting += store_keys(keys, waits, walker.waiting);
  }
  const std::int64_t first = hn::GetLane(nearest);
  const std::int64_t misses_all = first >= missed_key ? 1 : 0, mask = -misses_all;
  walker.next = (walker.waiting[-1] & mask) | (first & ~mask);
  walker.waiting -= misses_all;
}

constexpr std::size_t next_axis[]{1, 2, 0};

/// The corners of some faces, as seen along the ray.
struct Seen_corners {
  Lane_values x[3], y[3], depth[3];
};

HWY_INLINE Seen_corners see_corners(const Ray_block& block, const Walker& walker, std::size_t first) {
  const Ray_walks& walks = *walker.walks;
  const std::size_t ray = walker.lane, depth_axis = walks.depth_axis[ray];
  const std::size_t x_axis = next_axis[depth_axis], y_axis = next_axis[x_axis];
  const Lanes d;
  const auto of_ray = [&](const float(&values)[ray_tree_width]) HWY_ATTR { return hn::Set(d, values[ray]); };
  const Lane_values sign = of_ray(walks.slope[depth_axis]), start = of_ray(walks.start);
  const Lane_values slope_x = of_ray(walks.slope[x_axis]), slope_y = of_ray(walks.slope[y_axis]);
  const Lane_values across_x = of_ray(walks.across[x_axis]), across_y = of_ray(walks.across[y_axis]);
  Seen_corners seen;
  for (int c = 0; c < 3; ++c) {
    const Lane_values z = hn::Mul(sign, hn::Load(d, block.corners[c][depth_axis] + first));
    seen.x[c] = hn::Sub(hn::NegMulAdd(slope_x, z, hn::Load(d, block.corners[c][x_axis] + first)), across_x);
    seen.y[c] = hn::Sub(hn::NegMulAdd(slope_y, z, hn::Load(d, block.corners[c][y_axis] + first)), across_y);
    seen.depth[c] = hn::Sub(z, start);
  }
  return seen;
}

/// Of which faces floating point knows on which side of all edges the ray passes. See `estimate_some` in
/// `triangles/ray_depth_kernel.cpp` for the error of a weight.
struct Passes {
  hn::Mask<Lanes> beside, through;
};

HWY_INLINE Passes pass(const Seen_corners& seen) {
  const Lanes d;
  const auto &x = seen.x, &y = seen.y;
  Lane_values size = hn::Zero(d);
  for (int c = 0; c < 3; ++c) size = greatest(size, hn::Abs(x[c]), hn::Abs(y[c]));
  const Lane_values error = hn::Mul(hn::Set(d, 8 * walk_error), hn::Add(size, hn::Set(d, walk_error)));
  const Lane_values weight_0 = hn::Sub(hn::Mul(x[1], y[2]), hn::Mul(x[2], y[1]));
  const Lane_values weight_1 = hn::Sub(hn::Mul(x[2], y[0]), hn::Mul(x[0], y[2]));
  const Lane_values weight_2 = hn::Sub(hn::Mul(x[0], y[1]), hn::Mul(x[1], y[0]));
  const Lane_values low = least(weight_0, weight_1, weight_2), high = greatest(weight_0, weight_1, weight_2);
  return {hn::And(hn::Lt(low, hn::Neg(error)), hn::Gt(high, error)),
          hn::Or(hn::Gt(low, error), hn::Lt(high, hn::Neg(error)))};
}

/// Drops what waits and is too deep by now. So nothing that waits has to be looked at twice, and to go back to it takes
/// no branch.
HWY_INLINE void drop_deep(Walker& walker) {
  const Keys d;
  const auto too_deep = hn::Set(d, deeper_key(walker.most));
  std::int64_t* kept = walker.bottom;
  for (const std::int64_t* waiting = walker.bottom; waiting < walker.waiting; waiting += key_step) {
    const auto keys = hn::LoadU(d, waiting);
    const auto left = static_cast<std::size_t>(walker.waiting - waiting);
    kept += store_keys(keys, hn::And(hn::Lt(keys, too_deep), hn::FirstN(d, left)), kept);
  }
  walker.waiting = kept;
}

/// Lists the faces that the ray may meet. Those that it surely meets limit how deep it has to go.
/// @return a bit per face
template <Walk_until until>
HWY_INLINE std::uint32_t list_met(const Ray_block& block, Walker& walker) {
  const Lanes d;
  std::uint32_t met = 0;
  Lane_values surely_met = hn::Set(d, walker.most);
  for (std::size_t i = 0; i < ray_tree_width; i += step) {
    const Seen_corners seen = see_corners(block, walker, i);
    const Passes passes = pass(seen);
    const Lane_values nearest = least(seen.depth[0], seen.depth[1], seen.depth[2]);
    const Lane_values farthest = greatest(seen.depth[0], seen.depth[1], seen.depth[2]);
    const auto in_reach =
        hn::And(hn::Ge(farthest, hn::Set(d, -walk_error)), hn::Le(nearest, hn::Set(d, walker.most + walk_error)));
    met |= mask_bits(d, hn::AndNot(passes.beside, in_reach)) << i;
    if constexpr (until == Walk_until::first_hit) {
      const auto is_sure = hn::And(passes.through, hn::Gt(nearest, hn::Set(d, walk_error)));
      surely_met =
          hn::Min(surely_met, hn::IfThenElse(is_sure, hn::Add(farthest, hn::Set(d, 2 * walk_error)), surely_met));
    }
  }
  if constexpr (until == Walk_until::first_hit) walker.most = hn::GetLane(hn::MinOfLanes(d, surely_met));
  return met;
}

/// Lists the faces that the ray may meet, and goes on to what was left to wait last.
/// @return a bit per face
template <Walk_until until>
HWY_INLINE std::uint32_t visit_block(const Ray_block& block, Walker& walker) {
  const std::uint32_t met = list_met<until>(block, walker);
  if constexpr (until == Walk_until::first_hit) drop_deep(walker);
  walker.next = *--walker.waiting;
  return met;
}

/// Addresses of nodes and blocks, computed without a branch: which of the two a child is, is unpredictable.
struct Places {
  explicit Places(const Ray_nodes& tree)
      : begins{reinterpret_cast<const char*>(tree.nodes), reinterpret_cast<const char*>(tree.blocks)} {}

  /// @param mask  0: begin with the first of its kind
  HWY_INLINE const char* of(std::uint32_t child, std::size_t mask = ~std::size_t{0}) const {
    const std::size_t is_block = child >> 31;
    return begins[is_block] + sizes[is_block] * ((child & ~is_ray_block) & mask);
  }

  const char* begins[2];
  std::size_t sizes[2] = {sizeof(Ray_node), sizeof(Ray_block)};
};

/// Has most of a child read from memory, meanwhile; reading it brings the rest.
HWY_INLINE void prefetch(const char* child) {
  constexpr std::size_t line = 64;
  for (std::size_t i = 0; i < sizeof(Ray_node); i += line) hwy::Prefetch(child + i);
}

/// The same of what is looked at if the ray may meet a face of the block.
HWY_INLINE void prefetch_rest(const Ray_block& block) {
  hwy::Prefetch(block.vertices[1]);
  hwy::Prefetch(block.faces);
}

/// The same of the corners of the first face that the ray may meet, or of any. Without a branch.
HWY_INLINE void prefetch_corners(const Ray_nodes& tree, const Ray_block& block, std::uint32_t met) {
  constexpr std::uint32_t last = 1U << (ray_tree_width - 1);
  const std::size_t lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(met | last);
  for (const auto& corner : block.vertices) hwy::Prefetch(tree.coordinates + 3 * std::size_t{corner[lane]});
}

/// The walkers whose turn it is, by what they visit next: so it is known which it is.
struct Turn {
  Walker* at_nodes[ray_walkers];
  Walker* at_blocks[ray_walkers];
  Walker* at_end[ray_walkers];
  std::size_t nodes, blocks, ended;
};

/// Fills a turn. Not part of `Turn`, so that the numbers stay in registers while walkers are written.
class Turn_filler {
 public:
  Turn_filler(const Places& places, Turn& turn) : places_(places), turn_(turn) {}

  HWY_INLINE void add(Walker& walker) {
    const std::uint32_t child = child_of(walker.next);
    const std::size_t is_block = child >> 31, is_end = walker.next == end_of_walk ? 1 : 0;
    prefetch(places_.of(child, is_end - 1));
    turn_.at_nodes[nodes_] = turn_.at_blocks[blocks_] = turn_.at_end[ended_] = &walker;
    nodes_ += 1 - is_block;
    blocks_ += is_block - is_end;
    ended_ += is_end;
  }
  HWY_INLINE void finish() {
    turn_.nodes = nodes_;
    turn_.blocks = blocks_;
    turn_.ended = ended_;
  }

 private:
  const Places& places_;
  Turn& turn_;
  std::size_t nodes_ = 0, blocks_ = 0, ended_ = 0;
};

/// Walks some rays, with a few walkers. In each turn every walker takes one step. Which steps a ray takes is
/// unpredictable, so the walkers are sorted by them, and a step has no branches: a branch that is mistaken would undo
/// what the processor has begun for the walkers that follow.
template <Walk_until until>
class Walk_group {
 public:
  Walk_group(const Ray_nodes& tree, const Ray_walks* walks, std::span<const std::uint32_t> rays,
             Ray_candidate_list& candidates)
      : tree_(tree), places_(tree), walks_(walks), rays_(rays), candidates_(candidates) {}

  /// @param waiting  room for what waits, of all walkers
  HWY_INLINE void run(std::int64_t* waiting) {
    Walker walkers[ray_walkers];
    Turn turns[2];
    Turn *turn = turns, *next = turns + 1;
    turn->nodes = turn->blocks = 0;
    turn->ended = std::min(rays_.size(), ray_walkers);
    for (std::size_t i = 0; i < turn->ended; ++i) {
      walkers[i].bottom = waiting + i * tree_.waiting_room();
      turn->at_end[i] = &walkers[i];
    }
    do {
      Turn_filler filler(places_, *next);
      visit_blocks(*turn, filler);
      for (std::size_t i = 0; i < turn->nodes; ++i) {
        Walker& walker = *turn->at_nodes[i];
        visit_node(tree_.nodes[child_of(walker.next)], walker);
        filler.add(walker);
      }
      for (std::size_t i = 0; i < turn->ended && started_ < rays_.size(); ++i) {
        Walker& walker = *turn->at_end[i];
        start(walker, walks_, rays_[started_++], walker.bottom);
        filler.add(walker);
      }
      filler.finish();
      std::swap(turn, next);
    } while (turn->nodes + turn->blocks > 0 || started_ < rays_.size());
  }

 private:
  HWY_INLINE void visit_blocks(const Turn& turn, Turn_filler& filler) {
    Ray_candidates* const found = candidates_.room(ray_walkers);
    std::size_t count = 0;
    for (std::size_t i = 0; i < turn.blocks; ++i) {
      Walker& walker = *turn.at_blocks[i];
      const std::uint32_t block = child_of(walker.next) & ~is_ray_block;
      const std::uint32_t lanes = visit_block<until>(tree_.blocks[block], walker);
      found[count] = {walker.ray, block, lanes};
      count += lanes != 0 ? 1 : 0;
      filler.add(walker);
    }
    candidates_.add(count);
  }

  const Ray_nodes& tree_;
  const Places places_;
  const Ray_walks* walks_;
  std::span<const std::uint32_t> rays_;
  Ray_candidate_list& candidates_;
  std::size_t started_ = 0;
};

/// Walks a single ray. It has nobody to take turns with: with a branch that is guessed right, the next child is read
/// before it is known whether it is the next.
template <Walk_until until>
class Single_walk {
 public:
  Single_walk(const Ray_nodes& tree, Ray_candidate_list& candidates)
      : tree_(tree), places_(tree), candidates_(candidates) {}

  HWY_INLINE void run(const Ray_walks* walks, std::uint32_t ray, std::int64_t* waiting) {
    start(walker_, walks, ray, waiting);
    while (walker_.next != end_of_walk) {
      const std::uint32_t child = child_of(walker_.next);
      if ((child & is_ray_block) == 0)
        visit(tree_.nodes[child]);
      else
        visit_block(child & ~is_ray_block);
    }
  }

 private:
  /// Goes on to the nearest of the children that the ray meets.
  HWY_INLINE void visit(const Ray_node& node) {
    alignas(64) std::uint32_t depths[ray_tree_width];
    std::uint32_t left = enter_children(node, walker_, depths);
    if (left == 0) return go_back();
    const auto take = [&] {
      const std::size_t child = hwy::Num0BitsBelowLS1Bit_Nonzero32(left);
      left &= left - 1;
      prefetch(places_.of(node.children[child]));
      return std::int64_t{depths[child]} << 32 | std::int64_t{node.children[child]};
    };
    walker_.next = take();
    while (left != 0) {
      const std::int64_t other = take();
      *walker_.waiting++ = std::max(other, walker_.next);
      walker_.next = std::min(other, walker_.next);
    }
  }

  HWY_INLINE void visit_block(std::uint32_t index) {
    const Ray_block& block = tree_.blocks[index];
    prefetch_rest(block);
    const std::uint32_t lanes = list_met<until>(block, walker_);
    prefetch_corners(tree_, block, lanes);
    too_deep_ = deeper_key(walker_.most);
    *candidates_.room(1) = {walker_.ray, index, lanes};
    candidates_.add(lanes != 0 ? 1 : 0);
    go_back();
  }

  /// Goes on to what was left to wait last, unless it is too deep by now.
  HWY_INLINE void go_back() {
    do walker_.next = *--walker_.waiting;
    while (walker_.next >= too_deep_);
  }

  const Ray_nodes& tree_;
  const Places places_;
  Ray_candidate_list& candidates_;
  Walker walker_;
  std::int64_t too_deep_ = missed_key;
};

template <Walk_until until>
HWY_INLINE void walk(const Ray_nodes& tree, const Ray_walks* walks, std::span<const std::uint32_t> rays,
                     std::int64_t* waiting, Ray_candidate_list& candidates) {
  if (rays.size() == 1)
    Single_walk<until>(tree, candidates).run(walks, rays.front(), waiting);
  else
    Walk_group<until>(tree, walks, rays, candidates).run(waiting);
}

void walk_rays_kernel(const Ray_nodes& tree, const Ray_walks* walks, std::span<const std::uint32_t> rays,
                      Walk_until until, std::int64_t* waiting, Ray_candidate_list& candidates) {
  if (until == Walk_until::first_hit)
    walk<Walk_until::first_hit>(tree, walks, rays, waiting, candidates);
  else
    walk<Walk_until::end>(tree, walks, rays, waiting, candidates);
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(walk_rays_kernel);

Ray_candidates* Ray_candidate_list::room(std::size_t count) {
  if (count_ + count > list_.size()) list_.resize(2 * (count_ + count), boost::container::default_init);
  return list_.data() + count_;
}

void walk_rays(const Ray_nodes& tree, const Ray_walks* walks, std::span<const std::uint32_t> rays, Walk_until until,
               Ray_candidate_list& candidates) {
  boost::container::small_vector<std::int64_t, 64 * ray_walkers> waiting(
      std::min(rays.size(), ray_walkers) * tree.waiting_room(), boost::container::default_init);
  HWY_DYNAMIC_DISPATCH(walk_rays_kernel)(tree, walks, rays, until, waiting.data(), candidates);
}

}  // namespace lodestone::kernel
#endif
