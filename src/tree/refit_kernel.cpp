// SPDX-License-Identifier: GPL-3.0-or-later
#include "tree/refit_kernel.h"

#include <hwy/cache_control.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tree/refit_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/position_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using V = hn::Vec<D>;

struct Bounds {
  V low[vectors];
  V high[vectors];
  V sum[vectors];
};

/// Reads nothing past z: the last vertex of a list may be the last of the mesh.
HWY_INLINE void start_with_last(Bounds& bounds, const double* vertex) {
  for (std::size_t i = 0; i < vectors; ++i) bounds.low[i] = bounds.high[i] = bounds.sum[i] = load_last(vertex, i);
}

HWY_INLINE void extend(Bounds& bounds, const double* vertex) {
  for (std::size_t i = 0; i < vectors; ++i) {
    const auto x = hn::LoadU(D(), vertex + i * lanes);
    bounds.low[i] = hn::Min(bounds.low[i], x);
    bounds.high[i] = hn::Max(bounds.high[i], x);
    bounds.sum[i] = hn::Add(bounds.sum[i], x);
  }
}

/// Bounds of two vertices side by side where a vector holds eight doubles, else of one.
#if HWY_MAX_BYTES >= 64
constexpr std::size_t vertices_per_vector = 2;
using Wide = hn::CappedTag<double, 2 * lanes>;

struct Wide_bounds {
  hn::Vec<Wide> low[vectors];
  hn::Vec<Wide> high[vectors];
  hn::Vec<Wide> sum[vectors];
};

HWY_INLINE Wide_bounds widen(const Bounds& bounds) {
  const Wide d;
  return {{hn::Combine(d, bounds.low[0], bounds.low[0])},
          {hn::Combine(d, bounds.high[0], bounds.high[0])},
          {hn::Combine(d, bounds.sum[0], bounds.sum[0])}};
}
HWY_INLINE Bounds narrow(const Wide_bounds& bounds) {
  const D d;
  return {{hn::Min(hn::LowerHalf(d, bounds.low[0]), hn::UpperHalf(d, bounds.low[0]))},
          {hn::Max(hn::LowerHalf(d, bounds.high[0]), hn::UpperHalf(d, bounds.high[0]))},
          {hn::Add(hn::LowerHalf(d, bounds.sum[0]), hn::UpperHalf(d, bounds.sum[0]))}};
}
#else
constexpr std::size_t vertices_per_vector = 1;
using Wide = D;
using Wide_bounds = Bounds;

HWY_INLINE Wide_bounds widen(const Bounds& bounds) { return bounds; }
HWY_INLINE Bounds narrow(const Wide_bounds& bounds) { return bounds; }
#endif

/// Vector i of vertex `vertices[k]` and, where a vector holds two vertices, of `vertices[k + 2]`.
HWY_INLINE hn::Vec<Wide> load_wide(const double* coordinates, const std::uint32_t* vertices, std::size_t k,
                                   std::size_t i) {
  const auto first = hn::LoadU(D(), coordinates + 3 * std::size_t{vertices[k]} + i * lanes);
#if HWY_MAX_BYTES >= 64
  return hn::Combine(Wide(), hn::LoadU(D(), coordinates + 3 * std::size_t{vertices[k + 2]} + i * lanes), first);
#else
  return first;
#endif
}

/// Extends bounds by four vertices. These are combined with each other first, so that few instructions depend on the
/// bounds so far.
HWY_INLINE void extend(Wide_bounds& bounds, const double* coordinates, const std::uint32_t* vertices) {
  for (std::size_t i = 0; i < vectors; ++i) {
    const auto p = load_wide(coordinates, vertices, 0, i), q = load_wide(coordinates, vertices, 1, i);
    auto low = hn::Min(p, q), high = hn::Max(p, q), sum = hn::Add(p, q);
    if constexpr (vertices_per_vector == 1) {
      const auto r = load_wide(coordinates, vertices, 2, i), s = load_wide(coordinates, vertices, 3, i);
      low = hn::Min(low, hn::Min(r, s));
      high = hn::Max(high, hn::Max(r, s));
      sum = hn::Add(sum, hn::Add(r, s));
    }
    bounds.low[i] = hn::Min(bounds.low[i], low);
    bounds.high[i] = hn::Max(bounds.high[i], high);
    bounds.sum[i] = hn::Add(bounds.sum[i], sum);
  }
}

/// @tparam ahead  vertices by which memory is prefetched; 0: left to the processor
template <std::size_t ahead>
HWY_INLINE Bounds leaf_bounds(const double* coordinates, const std::uint32_t* vertex, const std::uint32_t* end) {
  const std::uint32_t* const last = end - 1;
  Bounds bounds;
  start_with_last(bounds, coordinates + 3 * std::size_t{*last});
  if (last - vertex < 4) {
    for (; vertex < last; ++vertex) extend(bounds, coordinates + 3 * std::size_t{*vertex});
    return bounds;
  }
  Wide_bounds wide = widen(bounds);
  for (; vertex + 4 <= last; vertex += 4) {
    if constexpr (ahead > 0)
      for (std::size_t k = 0; k < 4; ++k) hwy::Prefetch(coordinates + 3 * std::size_t{vertex[ahead + k]});
    extend(wide, coordinates, vertex);
  }
  // The last four at once, some of them a second time: that changes no minimum and no maximum.
  if (vertex < last) extend(wide, coordinates, last - 4);
  return narrow(wide);
}

template <std::size_t ahead>
HWY_INLINE Refit_sums refit_leaves_ahead(const Refit& refit, std::size_t first, std::size_t end) {
  const D d;
  V sums[vectors], extents[vectors];
  for (std::size_t i = 0; i < vectors; ++i) sums[i] = extents[i] = hn::Zero(d);
  for (std::size_t leaf = first; leaf < end; ++leaf) {
    const Bounds bounds = leaf_bounds<ahead>(refit.coordinates, refit.vertices + refit.vertex_begin[leaf],
                                             refit.vertices + refit.vertex_begin[leaf + 1]);
    Aabb& box = refit.boxes[refit.leaf_nodes[leaf]];
    for (std::size_t i = 0; i < vectors; ++i) {
      hn::Store(bounds.low[i], d, box.low + i * lanes);
      hn::Store(bounds.high[i], d, box.high + i * lanes);
      sums[i] = hn::Add(sums[i], bounds.sum[i]);
      extents[i] = hn::Add(extents[i], hn::Sub(bounds.high[i], bounds.low[i]));
    }
  }
  alignas(64) double sum[4], extent[4];
  for (std::size_t i = 0; i < vectors; ++i) {
    hn::Store(sums[i], d, sum + i * lanes);
    hn::Store(extents[i], d, extent + i * lanes);
  }
  return {.coordinates = sum[0] + sum[1] + sum[2], .extents = extent[0] + extent[1] + extent[2]};
}

Refit_sums refit_leaves_kernel(const Refit& refit, std::size_t first, std::size_t end) {
  return refit.beyond_cache ? refit_leaves_ahead<vertices_ahead>(refit, first, end)
                            : refit_leaves_ahead<0>(refit, first, end);
}

/// Four independent sums, so that no addition waits for the one before.
double sum_coordinates_kernel(const Refit& refit, std::size_t leaf) {
  const D d;
  const double* const coordinates = refit.coordinates;
  const std::uint32_t* vertex = refit.vertices + refit.vertex_begin[leaf];
  const std::uint32_t* const last = refit.vertices + refit.vertex_begin[leaf + 1] - 1;
  V sums[4][vectors];
  for (std::size_t i = 0; i < vectors; ++i) {
    for (auto& sum : sums) sum[i] = hn::Zero(d);
    sums[0][i] = load_last(coordinates + 3 * std::size_t{*last}, i);
  }
  for (; vertex + 4 <= last; vertex += 4)
    for (std::size_t k = 0; k < 4; ++k) {
      if (refit.beyond_cache) hwy::Prefetch(coordinates + 3 * std::size_t{vertex[vertices_ahead + k]});
      for (std::size_t i = 0; i < vectors; ++i)
        sums[k][i] = hn::Add(sums[k][i], hn::LoadU(d, coordinates + 3 * std::size_t{vertex[k]} + i * lanes));
    }
  for (; vertex < last; ++vertex)
    for (std::size_t i = 0; i < vectors; ++i)
      sums[1][i] = hn::Add(sums[1][i], hn::LoadU(d, coordinates + 3 * std::size_t{*vertex} + i * lanes));
  alignas(64) double sum[4];
  for (std::size_t i = 0; i < vectors; ++i)
    hn::Store(hn::Add(hn::Add(sums[0][i], sums[1][i]), hn::Add(sums[2][i], sums[3][i])), d, sum + i * lanes);
  return sum[0] + sum[1] + sum[2];
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(refit_leaves_kernel);

Refit_sums refit_leaves(const Refit& refit, std::size_t first, std::size_t end) {
  return HWY_DYNAMIC_DISPATCH(refit_leaves_kernel)(refit, first, end);
}

HWY_EXPORT(sum_coordinates_kernel);

double sum_coordinates(const Refit& refit, std::size_t leaf) {
  return HWY_DYNAMIC_DISPATCH(sum_coordinates_kernel)(refit, leaf);
}

}  // namespace lodestone::kernel
#endif
