// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/refit_kernel.h"

#include <hwy/cache_control.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/refit_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "contact/position_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using V = hn::Vec<D>;

struct Bounds {
  V low[vectors];
  V high[vectors];
  V sum[vectors];
};

HWY_INLINE void extend(Bounds& bounds, std::size_t i, V x) {
  bounds.low[i] = hn::Min(bounds.low[i], x);
  bounds.high[i] = hn::Max(bounds.high[i], x);
  bounds.sum[i] = hn::Add(bounds.sum[i], x);
}

HWY_INLINE void extend(Bounds& bounds, const double* vertex) {
  const D d;
  for (std::size_t i = 0; i < vectors; ++i) extend(bounds, i, hn::LoadU(d, vertex + i * lanes));
}

/// The last vertex of a list may be the last of the mesh: nothing past its z is read.
HWY_INLINE void start_last(Bounds& bounds, const double* vertex) {
  for (std::size_t i = 0; i < vectors; ++i) {
    const auto x = load_last(vertex, i);
    bounds.low[i] = x;
    bounds.high[i] = x;
    bounds.sum[i] = x;
  }
}

HWY_INLINE void merge(Bounds& bounds, const Bounds& other) {
  for (std::size_t i = 0; i < vectors; ++i) {
    bounds.low[i] = hn::Min(bounds.low[i], other.low[i]);
    bounds.high[i] = hn::Max(bounds.high[i], other.high[i]);
    bounds.sum[i] = hn::Add(bounds.sum[i], other.sum[i]);
  }
}

/// @tparam ahead  vertices by which memory is asked for before it is read; 0: the processor looks ahead by itself
template <std::size_t ahead>
HWY_INLINE double refit_leaves_ahead(const Refit& refit, std::size_t first, std::size_t end) {
  const D d;
  const double* coordinates = refit.coordinates;
  V sums[vectors];
  for (auto& sum : sums) sum = hn::Zero(d);
  for (std::size_t leaf = first; leaf < end; ++leaf) {
    const std::uint32_t* vertex = refit.vertices + refit.vertex_begin[leaf];
    const std::uint32_t* const last = refit.vertices + refit.vertex_begin[leaf + 1] - 1;
    // Two independent chains, so that no instruction waits for the one before it.
    Bounds even, odd;
    start_last(even, coordinates + 3 * std::size_t{*last});
    odd = even;
    for (; vertex + 1 < last; vertex += 2) {
      if constexpr (ahead > 0) {
        hwy::Prefetch(coordinates + 3 * std::size_t{vertex[ahead]});
        hwy::Prefetch(coordinates + 3 * std::size_t{vertex[ahead + 1]});
      }
      extend(even, coordinates + 3 * std::size_t{vertex[0]});
      extend(odd, coordinates + 3 * std::size_t{vertex[1]});
    }
    if (vertex < last) extend(even, coordinates + 3 * std::size_t{*vertex});
    merge(even, odd);
    Tree_box& box = refit.boxes[refit.leaf_nodes[leaf]];
    for (std::size_t i = 0; i < vectors; ++i) {
      hn::Store(even.low[i], d, box.low + i * lanes);
      hn::Store(even.high[i], d, box.high + i * lanes);
      sums[i] = hn::Add(sums[i], even.sum[i]);
    }
  }
  double total = 0;
  for (const auto& sum : sums) total += hn::GetLane(hn::SumOfLanes(d, sum));
  return total;
}

double refit_leaves_kernel(const Refit& refit, std::size_t first, std::size_t end) {
  return refit.beyond_cache ? refit_leaves_ahead<vertices_ahead>(refit, first, end)
                            : refit_leaves_ahead<0>(refit, first, end);
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(refit_leaves_kernel);

double refit_leaves(const Refit& refit, std::size_t first, std::size_t end) {
  return HWY_DYNAMIC_DISPATCH(refit_leaves_kernel)(refit, first, end);
}

}  // namespace lodestone::kernel
#endif
