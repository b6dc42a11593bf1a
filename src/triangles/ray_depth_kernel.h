// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

/// Where rays meet triangles, as far as floating point can tell, built for several instruction sets and chosen at run
/// time. All give the same bits.
namespace lodestone::kernel {

/// Bounds on errors: see `frame_error`.
constexpr double most_reach = 1e150, error_per_reach = 0x1p-50, error_of_underflow = 0x1p-1000;

/// Rays and triangles that are asked about at once.
constexpr std::size_t most_depth_questions = 8;

/// Rays, and a triangle for each. See `Ray_frame`.
struct alignas(64) Depth_questions {
  double x[3][most_depth_questions];  ///< each corner less the origin, along the axes of the frame
  double y[3][most_depth_questions];
  double z[3][most_depth_questions];
  double shear[2][most_depth_questions];
  double sign[most_depth_questions];
  double least_limit[most_depth_questions];
  double most_limit[most_depth_questions];
};

/// What floating point can tell.
struct alignas(64) Depth_estimates {
  double low[most_depth_questions];  ///< the depth of the first common point, if there is any, is between these
  double high[most_depth_questions];
  std::uint32_t misses;  ///< a bit per question: there surely is none
  std::uint32_t meets;   ///< there surely is one
};

/// @param count      how many are asked, from the first on; the others need not be set
/// @param estimates  valid for those that are asked; the rest is unspecified
void estimate_depths(const Depth_questions& questions, std::size_t count, Depth_estimates& estimates);

}  // namespace lodestone::kernel
