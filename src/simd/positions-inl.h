// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_POSITIONS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_POSITIONS_INL_H
#undef LODESTONE_POSITIONS_INL_H
#else
#define LODESTONE_POSITIONS_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>

#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Vector `i` of a position. Reads nothing past its z, so it may be the last position of the mesh.
///
/// `MaskedLoad` reads only the lanes of its mask, and needs no alignment, only where the processor has such an
/// instruction: with four lanes it does.
HWY_INLINE Position_vector load_position(const double* position, std::size_t i) {
  const Position_lanes d;
  if constexpr (position_lanes == 4) return hn::MaskedLoad(hn::FirstN(d, 3), d, position);
  return (i + 1) * position_lanes <= 3 ? hn::LoadU(d, position + i * position_lanes) : hn::Set(d, position[2]);
}

/// The same of a position that is not the last of the mesh. Reads one number past its z.
HWY_INLINE Position_vector load_inner_position(const double* position, std::size_t i) {
  return hn::LoadU(Position_lanes(), position + i * position_lanes);
}

/// Transposes rows, one position each, to x, y and z: as many positions as a vector holds doubles.
/// @param row  `row(lane, i)` is vector `i` of a position
template <class Row>
HWY_INLINE Vector3<Double_lanes> transpose(const Row& row) {
#if HWY_MAX_BYTES >= 64
  const Double_lanes d;
  // Each half of a vector is a row.
  const auto two_rows = [&](std::size_t lane) HWY_ATTR { return hn::Combine(d, row(lane + 4, 0), row(lane, 0)); };
  const auto row0 = two_rows(0), row1 = two_rows(1), row2 = two_rows(2), row3 = two_rows(3);
  const auto xz01 = hn::InterleaveLower(d, row0, row1), xz23 = hn::InterleaveLower(d, row2, row3);
  const auto y01 = hn::InterleaveUpper(d, row0, row1), y23 = hn::InterleaveUpper(d, row2, row3);
  return {hn::OddEvenBlocks(hn::SwapAdjacentBlocks(xz23), xz01), hn::OddEvenBlocks(hn::SwapAdjacentBlocks(y23), y01),
          hn::OddEvenBlocks(xz23, hn::SwapAdjacentBlocks(xz01))};
#elif HWY_MAX_BYTES >= 32
  const Double_lanes d;
  const auto row0 = row(0, 0), row1 = row(1, 0), row2 = row(2, 0), row3 = row(3, 0);
  const auto xz01 = hn::InterleaveLower(d, row0, row1), xz23 = hn::InterleaveLower(d, row2, row3);
  const auto y01 = hn::InterleaveUpper(d, row0, row1), y23 = hn::InterleaveUpper(d, row2, row3);
  return {hn::ConcatLowerLower(d, xz23, xz01), hn::ConcatLowerLower(d, y23, y01), hn::ConcatUpperUpper(d, xz23, xz01)};
#elif HWY_TARGET != HWY_SCALAR
  const Double_lanes d;
  const auto xy0 = row(0, 0), xy1 = row(1, 0);
  return {hn::InterleaveLower(d, xy0, xy1), hn::InterleaveUpper(d, xy0, xy1),
          hn::InterleaveLower(d, row(0, 1), row(1, 1))};
#else
  return {row(0, 0), row(0, 1), row(0, 2)};
#endif
}

/// x, y and z of one position per lane. Reads nothing past a z.
/// @param position  `position(lane)` points to x
template <class Position>
HWY_INLINE Vector3<Double_lanes> load_positions(const Position& position) {
  return transpose([&](std::size_t lane, std::size_t i) HWY_ATTR { return load_position(position(lane), i); });
}

/// The same of positions none of which is the last of the mesh. Reads one number past each z.
template <class Position>
HWY_INLINE Vector3<Double_lanes> load_inner_positions(const Position& position) {
  return transpose([&](std::size_t lane, std::size_t i) HWY_ATTR { return load_inner_position(position(lane), i); });
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
