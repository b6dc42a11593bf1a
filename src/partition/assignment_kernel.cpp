// SPDX-License-Identifier: GPL-3.0-or-later
#include "partition/assignment_kernel.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "partition/assignment_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "partition/fixed_components.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

static_assert(block_size % double_lanes == 0);

/// Same as std::sqrt, but without its branch for errno.
HWY_INLINE double square_root(double x) {
  const hn::CappedTag<double, 1> d;
  return hn::GetLane(hn::Sqrt(hn::Set(d, x)));
}

/// Finds the nearest and second nearest code vector of vector `v`, around its present one. Branchless in the distances:
/// which of them is the least is unpredictable, and a misprediction costs more than the eight distances.
template <int K>
HWY_INLINE void search(Bounded_pass& pass, std::size_t v) {
  const Double_lanes d;
  const std::size_t k = K > 0 ? K : pass.components;
  const double* vector = pass.blocks + v / block_size * block_size * k + v % block_size;
  const Neighbourhood& around = pass.neighbourhoods[pass.labels[v]];
  const auto infinity = hn::Set(d, std::numeric_limits<double>::infinity());

  // The present code vector competes in the first lane.
  auto nearest = hn::IfThenElse(hn::FirstN(d, 1), hn::Set(d, pass.squared_distances[v]), infinity);
  auto label = hn::Set(d, static_cast<double>(pass.labels[v]));
  auto second = infinity;

  // The nearest and the second nearest code vector both lie within 2 distance + gap of the present one.
  const double reach = (2 * square_root(pass.squared_distances[v]) + around.distances[0]) * (1 + 1e-9) + pass.margin;
  std::size_t first = 0;
  for (; first < around.count && around.distances[first] <= reach; first += block_size) {
    for (std::size_t lane = 0; lane < block_size; lane += double_lanes) {
      auto squared = hn::Zero(d);
      for (std::size_t i = 0; i < k; ++i) {
        const auto row = hn::LoadU(d, around.components + first * k + i * block_size + lane);
        const auto difference = hn::Sub(hn::Set(d, vector[i * block_size]), row);
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

  // The nearest of the lanes' winners is chosen; ties go to the lowest index. All other winners are runners-up.
  const auto least = hn::MinOfLanes(d, nearest);
  const auto chosen = hn::MinOfLanes(d, hn::IfThenElse(hn::Eq(nearest, least), label, infinity));
  const auto is_chosen = hn::And(hn::Eq(nearest, least), hn::Eq(label, chosen));
  const auto runner_up = hn::MinOfLanes(d, hn::Min(second, hn::IfThenElse(is_chosen, infinity, nearest)));
  pass.labels[v] = static_cast<std::uint32_t>(hn::GetLane(chosen));
  pass.squared_distances[v] = hn::GetLane(least);
  pass.second_bounds[v] = square_root(hn::GetLane(runner_up)) * (1 - 1e-9) + pass.drifts[pass.labels[v]];
}

/// Eight vectors with the same code vector, one vector per lane: checks the bounds, and searches where they fail.
template <int K>
HWY_INLINE void pass_uniform_block(Bounded_pass& pass, std::size_t block) {
  const Double_lanes d;
  const std::size_t k = K > 0 ? K : pass.components;
  const std::uint32_t start = pass.labels[block * block_size];
  const double* code = pass.codes + start * k;
  const Neighbourhood& around = pass.neighbourhoods[start];

  for (std::size_t lane = 0; lane < block_size; lane += double_lanes) {
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
    pass.distance_evaluations += tried * double_lanes;

    HWY_ALIGN double is_open[block_size], labels[block_size], squared[block_size], bounds[block_size];
    hn::Store(hn::IfThenElseZero(open, hn::Set(d, 1.0)), d, is_open);
    hn::Store(label, d, labels);
    hn::Store(nearest, d, squared);
    hn::Store(hn::Mul(hn::Sqrt(second), hn::Set(d, 1 - 1e-9)), d, bounds);
    for (std::size_t i = 0; i < double_lanes; ++i) {
      if (is_open[i] == 0) continue;
      pass.labels[v + i] = static_cast<std::uint32_t>(labels[i]);
      pass.squared_distances[v + i] = squared[i];
      pass.second_bounds[v + i] = bounds[i] + pass.drifts[pass.labels[v + i]];
    }
  }
}

/// The vectors of a block with different code vectors, or of an incomplete block, one by one.
template <int K>
HWY_INLINE void pass_mixed_block(Bounded_pass& pass, std::size_t begin, std::size_t count) {
  const std::size_t k = K > 0 ? K : pass.components;
  const double* components = pass.blocks + begin * k;
  std::uint32_t labels[block_size] = {};
  std::copy_n(pass.labels + begin, count, labels);
  double nearest[block_size] = {};
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t lane = 0; lane < block_size; ++lane) {
      const double difference = components[i * block_size + lane] - pass.codes[labels[lane] * k + i];
      nearest[lane] += difference * difference;
    }
  std::copy_n(nearest, count, pass.squared_distances + begin);

  // Which vectors the bounds leave open is unpredictable, so they are collected branchless.
  std::size_t open[block_size], open_count = 0;
  for (std::size_t lane = 0; lane < count; ++lane) {
    const double second = pass.second_bounds[begin + lane] - pass.drifts[labels[lane]];
    const double bound = std::max(second, pass.half_gaps[labels[lane]]);
    open[open_count] = begin + lane;
    open_count += nearest[lane] * (1 + 1e-9) < bound * bound ? 0 : 1;
  }
  for (std::size_t i = 0; i < open_count; ++i) search<K>(pass, open[i]);
}

HWY_INLINE bool is_uniform(const std::uint32_t* labels) {
  std::uint32_t differences = 0;
  for (std::size_t lane = 1; lane < block_size; ++lane) differences |= labels[lane] ^ labels[0];
  return differences == 0;
}

/// Adds the vectors of a block, in order, to the sums of their cells.
template <int K>
HWY_INLINE void add_to_cells(Bounded_pass& pass, std::size_t begin, std::size_t count) {
  const std::size_t k = K > 0 ? K : pass.components;
  const double* components = pass.blocks + begin * k;
  const std::uint32_t* labels = pass.labels + begin;
  if (count == block_size && is_uniform(labels)) {
    double* sum = pass.cell_sums + labels[0] * k;
    for (std::size_t i = 0; i < k; ++i) {
      double total = sum[i];
      for (std::size_t lane = 0; lane < block_size; ++lane) total += components[i * block_size + lane];
      sum[i] = total;
    }
    pass.cell_sizes[labels[0]] += block_size;
    return;
  }
  for (std::size_t lane = 0; lane < count; ++lane) {
    double* sum = pass.cell_sums + labels[lane] * k;
    for (std::size_t i = 0; i < k; ++i) sum[i] += components[i * block_size + lane];
    ++pass.cell_sizes[labels[lane]];
  }
}

template <int K>
HWY_INLINE void pass_over(Bounded_pass& pass) {
  for (std::size_t begin = pass.begin; begin < pass.end; begin += block_size) {
    const std::size_t count = std::min(block_size, pass.end - begin);
    if (count == block_size && is_uniform(pass.labels + begin))
      pass_uniform_block<K>(pass, begin / block_size);
    else
      pass_mixed_block<K>(pass, begin, count);
    add_to_cells<K>(pass, begin, count);
  }
  pass.distance_evaluations += pass.end - pass.begin;
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
