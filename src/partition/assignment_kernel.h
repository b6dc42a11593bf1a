// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

/// The inner loops of the search for nearest code vectors, built for several instruction sets and dispatched at run
/// time. Each adds the components of a distance from the first to the last, so all give the same bits.
namespace lodestone::kernel {

inline constexpr std::size_t block_size = 8;

/// The code vectors around one of them, by distance from it, in blocks of eight. The padding of the last block consists
/// of code vectors infinitely far away.
struct Neighbourhood {
  const double* distances;   ///< from the code vector in the middle
  const double* codes;       ///< their indices
  const double* components;  ///< per block: k rows of eight
  std::size_t count;         ///< without padding
};

/// One pass over a chunk of the vectors. See Bounded_assignment for what the bounds mean.
struct Bounded_pass {
  const double* blocks;                 ///< eight vectors a block: k rows of eight; the last is padded with zeros
  std::size_t begin, end;               ///< the chunk; `begin` is the start of a block
  std::size_t components;               ///< k
  const double* codes;                  ///< N x k
  const Neighbourhood* neighbourhoods;  ///< N
  const double* half_gaps;              ///< N: half the distance to the nearest other, less the margin; at least 0
  const double* drifts;                 ///< N: upper bound on the motion of all others since the last reset
  double margin;

  std::uint32_t* labels;      ///< M: start of each search on entry, result on return
  double* squared_distances;  ///< M
  double* second_bounds;      ///< M: lower bound on the distance to all other code vectors, plus the drift of the own
  double* cell_sums;          ///< N x k, of the chunk: its vectors are added in order
  std::uint64_t* cell_sizes;  ///< N, of the chunk
  std::uint64_t distance_evaluations;
};

void bounded_pass(Bounded_pass& pass);

}  // namespace lodestone::kernel
