// SPDX-License-Identifier: GPL-3.0-or-later
#include "assignment_kernel.h"

#include <algorithm>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "partition/assignment_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "partition/fixed_components.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// As std::sqrt, without its branch for errno.
HWY_INLINE double square_root(double x) {
  const hn::CappedTag<double, 1> d;
  return hn::GetLane(hn::Sqrt(hn::Set(d, x)));
}

/// Nearest and second nearest code vector of vector `v`, searched around the one it has. Without branches on distances:
/// which of them is the least is as good as random, and a wrong guess costs more than the eight distances.
template <int K>
HWY_INLINE void search(Bounded_pass& pass, std::size_t v) {
  const hn::CappedTag<double, block_size> d;
  const std::size_t k = K > 0 ? K : pass.components;
  const double* vector = pass.vectors + v * k;
  const Neighbourhood& around = pass.neighbourhoods[pass.labels[v]];
  const auto infinity = hn::Set(d, std::numeric_limits<double>::infinity());

  // The code vector we start from competes in the first lane.
  auto nearest = hn::IfThenElse(hn::FirstN(d, 1), hn::Set(d, pass.squared_distances[v]), infinity);
  auto label = hn::Set(d, static_cast<double>(pass.labels[v]));
  auto second = infinity;

  // Both the nearest and the second nearest code vector lie within 2 distance + gap of the one we start from.
  const double reach = (2 * square_root(pass.squared_distances[v]) + around.distances[0]) * (1 + 1e-9) + pass.margin;
  std::size_t first = 0;
  for (; first < around.count && around.distances[first] <= reach; first += block_size) {
    for (std::size_t lane = 0; lane < block_size; lane += hn::Lanes(d)) {
      auto squared = hn::Zero(d);
      for (std::size_t i = 0; i < k; ++i) {
        const auto row = hn::LoadU(d, around.components + first * k + i * block_size + lane);
        const auto difference = hn::Sub(hn::Set(d, vector[i]), row);
        squared = hn::Add(squared, hn::Mul(difference, difference));
      }
      const auto code = hn::LoadU(d, around.codes + first + lane);
      const auto wins = hn::Or(hn::Lt(squared, nearest), hn::And(hn::Eq(squared, nearest), hn::Lt(code, label)));
      second = hn::Min(second, hn::IfThenElse(wins, nearest, squared));
      nearest = hn::IfThenElse(wins, squared, nearest);
      label = hn::IfThenElse(wins, code, label);
    }
  }
  pass.distance_evaluations += std::min(first, around.count);

  // Of the lanes' winners the nearest, of equal ones the lowest number; every other winner is a runner-up.
  const auto least = hn::MinOfLanes(d, nearest);
  const auto chosen = hn::MinOfLanes(d, hn::IfThenElse(hn::Eq(nearest, least), label, infinity));
  const auto is_chosen = hn::And(hn::Eq(nearest, least), hn::Eq(label, chosen));
  const auto runner_up = hn::MinOfLanes(d, hn::Min(second, hn::IfThenElse(is_chosen, infinity, nearest)));
  pass.labels[v] = static_cast<std::uint32_t>(hn::GetLane(chosen));
  pass.squared_distances[v] = hn::GetLane(least);
  pass.second_bounds[v] = square_root(hn::GetLane(runner_up)) * (1 - 1e-9) + pass.drifts[pass.labels[v]];
}

/// Distances of some vectors to the code vectors they have, and which of them the bounds leave open.
/// @return how many were written to `open`
template <int K>
HWY_INLINE std::size_t test_bounds(const Bounded_pass& pass, std::size_t begin, std::size_t end, std::uint32_t* open) {
  const std::size_t k = K > 0 ? K : pass.components;
  const double* HWY_RESTRICT vectors = pass.vectors;
  const double* HWY_RESTRICT codes = pass.codes;
  double* HWY_RESTRICT squared_distances = pass.squared_distances;
  std::size_t count = 0;
  for (std::size_t v = begin; v < end; ++v) {
    const std::uint32_t label = pass.labels[v];
    const double nearest = squared_distance<K>(vectors + v * k, codes + label * k, static_cast<std::ptrdiff_t>(k));
    squared_distances[v] = nearest;
    const double bound = std::max(pass.second_bounds[v] - pass.drifts[label], pass.half_gaps[label]);
    open[count] = static_cast<std::uint32_t>(v);
    count += nearest * (1 + 1e-9) < bound * bound ? 0 : 1;
  }
  return count;
}

/// Adds the vectors from `begin` to `end` to the sums of their cells, in order.
template <int K>
HWY_INLINE void add_to_cells(Bounded_pass& pass, std::size_t begin, std::size_t end) {
  const hn::CappedTag<double, block_size> d;
  const std::size_t k = K > 0 ? K : pass.components;
  for (std::size_t v = begin; v < end;) {
    // Neighbours mostly share a cell: its sum stays in a register until the cell changes.
    const std::uint32_t label = pass.labels[v];
    double* sum = pass.cell_sums + label * k;
    std::size_t run_end = v + 1;
    while (run_end < end && pass.labels[run_end] == label) ++run_end;
    pass.cell_sizes[label] += run_end - v;
    if (hn::Lanes(d) == block_size && k <= block_size) {
      const auto components = hn::FirstN(d, k);
      auto total = hn::MaskedLoad(components, d, sum);
      for (; v < run_end; ++v) total = hn::Add(total, hn::MaskedLoad(components, d, pass.vectors + v * k));
      hn::BlendedStore(total, components, d, sum);
    } else {
      for (; v < run_end; ++v)
        for (std::size_t i = 0; i < k; ++i) sum[i] += pass.vectors[v * k + i];
    }
  }
}

/// Eight vectors that have one and the same code vector, a vector per lane: bounds, and the search where they fail.
template <int K>
HWY_INLINE void pass_uniform_block(Bounded_pass& pass, std::size_t block) {
  const hn::CappedTag<double, block_size> d;
  const std::size_t k = K > 0 ? K : pass.components;
  const std::uint32_t start = pass.labels[block * block_size];
  const double* code = pass.codes + start * k;
  const Neighbourhood& around = pass.neighbourhoods[start];

  for (std::size_t lane = 0; lane < block_size; lane += hn::Lanes(d)) {
    const std::size_t v = block * block_size + lane;
    const double* components = pass.blocks + block * block_size * k + lane;
    const auto distance_to = [&](const double* other, std::size_t stride) HWY_ATTR {
      auto squared = hn::Zero(d);
      for (std::size_t i = 0; i < k; ++i) {
        const auto difference = hn::Sub(hn::LoadU(d, components + i * block_size), hn::Set(d, other[i * stride]));
        squared = hn::Add(squared, hn::Mul(difference, difference));
      }
      return squared;
    };
    auto nearest = distance_to(code, 1);
    hn::StoreU(nearest, d, pass.squared_distances + v);
    const auto bound = hn::Max(hn::Sub(hn::LoadU(d, pass.second_bounds + v), hn::Set(d, pass.drifts[start])),
                               hn::Set(d, pass.half_gaps[start]));
    const auto open = hn::Ge(hn::Mul(nearest, hn::Set(d, 1 + 1e-9)), hn::Mul(bound, bound));
    if (hn::AllFalse(d, open)) continue;

    const double farthest = hn::GetLane(hn::MaxOfLanes(d, hn::IfThenElseZero(open, nearest)));
    const double reach = (2 * square_root(farthest) + around.distances[0]) * (1 + 1e-9) + pass.margin;
    auto label = hn::Set(d, static_cast<double>(start));
    auto second = hn::Set(d, std::numeric_limits<double>::infinity());
    std::size_t tried = 0;
    for (; tried < around.count && around.distances[tried] <= reach; ++tried) {
      const std::size_t first = tried / block_size * block_size;
      const auto squared = distance_to(around.components + first * k + tried % block_size, block_size);
      const auto other = hn::Set(d, around.codes[tried]);
      const auto wins = hn::Or(hn::Lt(squared, nearest), hn::And(hn::Eq(squared, nearest), hn::Lt(other, label)));
      second = hn::Min(second, hn::IfThenElse(wins, nearest, squared));
      nearest = hn::IfThenElse(wins, squared, nearest);
      label = hn::IfThenElse(wins, other, label);
    }
    pass.distance_evaluations += tried * hn::Lanes(d);

    HWY_ALIGN double is_open[block_size], labels[block_size], squared[block_size], bounds[block_size];
    hn::Store(hn::IfThenElseZero(open, hn::Set(d, 1.0)), d, is_open);
    hn::Store(label, d, labels);
    hn::Store(nearest, d, squared);
    hn::Store(hn::Mul(hn::Sqrt(second), hn::Set(d, 1 - 1e-9)), d, bounds);
    for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
      if (is_open[i] == 0) continue;
      pass.labels[v + i] = static_cast<std::uint32_t>(labels[i]);
      pass.squared_distances[v + i] = squared[i];
      pass.second_bounds[v + i] = bounds[i] + pass.drifts[pass.labels[v + i]];
    }
  }
}

/// The vectors from `begin` to `end`, at most eight, one by one.
template <int K>
HWY_INLINE void pass_mixed_block(Bounded_pass& pass, std::size_t begin, std::size_t end) {
  std::uint32_t open[block_size];
  const std::size_t count = test_bounds<K>(pass, begin, end, open);
  for (std::size_t i = 0; i < count; ++i) search<K>(pass, open[i]);
}

template <int K>
HWY_INLINE void pass_over(Bounded_pass& pass) {
  for (std::size_t begin = 0; begin < pass.vector_count; begin += block_size) {
    const std::size_t end = std::min(begin + block_size, pass.vector_count);
    std::uint32_t differences = 0;
    for (std::size_t v = begin; v < end; ++v) differences |= pass.labels[v] ^ pass.labels[begin];
    if (differences == 0 && end - begin == block_size)
      pass_uniform_block<K>(pass, begin / block_size);
    else
      pass_mixed_block<K>(pass, begin, end);
  }
  add_to_cells<K>(pass, 0, pass.vector_count);
  pass.distance_evaluations += pass.vector_count;
}

void run_pass(Bounded_pass& pass) {
  with_fixed_components(static_cast<std::ptrdiff_t>(pass.components), [&](auto k) { pass_over<k.value>(pass); });
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(run_pass);

void bounded_pass(Bounded_pass& pass) { HWY_DYNAMIC_DISPATCH(run_pass)(pass); }

}  // namespace lodestone::kernel
#endif
