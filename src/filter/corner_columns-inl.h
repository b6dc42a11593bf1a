// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_CORNER_COLUMNS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_CORNER_COLUMNS_INL_H
#undef LODESTONE_CORNER_COLUMNS_INL_H
#else
#define LODESTONE_CORNER_COLUMNS_INL_H
#endif

#include <hwy/highway.h>

#include "filter/filter_scratch.h"
#include "filter/separation-inl.h"
#include "lodestone/volumes/leaf_faces.h"
#include "simd/position_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A face of one leaf per lane.
struct Lane_faces {
  const double* coordinates;      ///< of the mesh
  const std::uint32_t* vertices;  ///< of the leaf
  const Leaf_corners* corners[widest];

  const double* position(std::size_t lane, std::size_t corner) const {
    return coordinates + 3 * std::size_t{vertices[(*corners[lane])[corner]]};
  }
};

#if HWY_MAX_BYTES >= 32
/// Where one corner of each face is, by coordinate: rows of four doubles are transposed within registers.
HWY_INLINE Vector3<Lanes> load_corner(const Lane_faces& faces, std::size_t corner) {
  const Lanes d;
  // Half a vector has the rows of four lanes.
  const auto rows = [&](std::size_t lane) HWY_ATTR {
#if HWY_MAX_BYTES >= 64
    return hn::Combine(d, load_last(faces.position(lane + 4, corner), 0), load_last(faces.position(lane, corner), 0));
#else
    return load_last(faces.position(lane, corner), 0);
#endif
  };
  const auto row0 = rows(0), row1 = rows(1), row2 = rows(2), row3 = rows(3);
  const auto xz01 = hn::InterleaveLower(d, row0, row1), xz23 = hn::InterleaveLower(d, row2, row3);
  const auto y01 = hn::InterleaveUpper(d, row0, row1), y23 = hn::InterleaveUpper(d, row2, row3);
  return {hn::OddEvenBlocks(hn::SwapAdjacentBlocks(xz23), xz01), hn::OddEvenBlocks(hn::SwapAdjacentBlocks(y23), y01),
          hn::OddEvenBlocks(xz23, hn::SwapAdjacentBlocks(xz01))};
}
#else
HWY_INLINE Vector3<Lanes> load_corner(const Lane_faces& faces, std::size_t corner) {
  const Lanes d;
  alignas(16) double columns[3][hn::MaxLanes(Lanes())];
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane)
    for (std::size_t axis = 0; axis < 3; ++axis) columns[axis][lane] = faces.position(lane, corner)[axis];
  return {hn::Load(d, columns[0]), hn::Load(d, columns[1]), hn::Load(d, columns[2])};
}
#endif

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
