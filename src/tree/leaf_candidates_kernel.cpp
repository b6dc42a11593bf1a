// SPDX-License-Identifier: GPL-3.0-or-later
#include "tree/leaf_candidates_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tree/leaf_candidates_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A box, its high sides moved out by the margin.
struct Grown_box {
  const Aabb& box;
  Position_vector low[position_vectors], high[position_vectors];

  HWY_INLINE Grown_box(const Aabb& around, double margin) : box(around) {
    const Position_lanes d;
    for (std::size_t i = 0; i < position_vectors; ++i) {
      low[i] = hn::Load(d, box.low + i * position_lanes);
      high[i] = hn::Add(hn::Load(d, box.high + i * position_lanes), hn::Set(d, margin));
    }
  }
};

/// 1 if two boxes are within the margin of each other, as `near(Aabb, Aabb, margin)` is, else 0.
HWY_INLINE std::size_t is_candidate(const Grown_box& a, const Aabb& b, double margin) {
  const Grown_box other(b, margin);
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < position_vectors; ++i) {
    const auto overlap = hn::And(hn::Le(a.low[i], other.high[i]), hn::Le(other.low[i], a.high[i]));
    bits |= mask_bits(Position_lanes(), overlap) << (i * position_lanes);
  }
  const std::size_t overlap = (bits & 7U) == 7U ? 1 : 0;  // x, y and z
  return margin > 0 && overlap != 0 ? static_cast<std::size_t>(near(a.box, b, margin)) : overlap;
}

/// Lists the leaves that are near a box. Which are is unpredictable, so branchless, but for a margin.
HWY_INLINE std::size_t cull_by_box(const Leaf_bunch& leaves, const Aabb& box, double margin, std::uint8_t* list) {
  const Grown_box grown(box, margin);
  std::size_t count = 0;
  for (std::uint32_t leaf = 0; leaf < leaves.count; ++leaf) {
    list[count] = static_cast<std::uint8_t>(leaf);
    count += is_candidate(grown, leaves.boxes[leaves.nodes[leaf]], margin);
  }
  return count;
}

void list_leaf_candidates_kernel(const Leaf_bunch& a, const Leaf_bunch& b, double margin, Leaf_candidates& candidates) {
  std::uint8_t leaves_a[bunch_leaves + 1], leaves_b[bunch_leaves + 1];
  const std::size_t count_a = cull_by_box(a, *b.around, margin, leaves_a);
  const std::size_t count_b = cull_by_box(b, *a.around, margin, leaves_b);
  std::size_t count = 0;
  for (std::size_t i = 0; i < count_a; ++i) {
    const Grown_box box(a.boxes[a.nodes[leaves_a[i]]], margin);
    for (std::size_t j = 0; j < count_b; ++j) {
      candidates.a[count] = leaves_a[i];
      candidates.b[count] = leaves_b[j];
      count += is_candidate(box, b.boxes[b.nodes[leaves_b[j]]], margin);
    }
  }
  candidates.count = count;
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(list_leaf_candidates_kernel);

void list_leaf_candidates(const Leaf_bunch& a, const Leaf_bunch& b, double margin, Leaf_candidates& candidates) {
  HWY_DYNAMIC_DISPATCH(list_leaf_candidates_kernel)(a, b, margin, candidates);
}

}  // namespace lodestone::kernel
#endif
