// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

/// Moving vertices to their pose, built for several instruction sets and chosen at run time. All give the same bits.
namespace lodestone::kernel {

/// What moves vertices: see Skinned_points.
struct Skin {
  const std::uint32_t* begin;  ///< per vertex and past the last
  const std::uint32_t* joints;
  const double* weights;
  const double* columns;  ///< 16 per joint
};

/// Skins vertices.
/// @param vertices     null: 0 to `count` - 1
/// @param shape        three coordinates per vertex of the mesh, before skinning
/// @param coordinates  three per vertex of the mesh, after it; may be `shape`
void skin(const Skin& skin, const std::uint32_t* vertices, std::size_t count, const double* shape, double* coordinates);

/// to[i] += weight * offsets[i]
void add_scaled(const double* offsets, std::size_t count, double weight, double* to);

}  // namespace lodestone::kernel
