// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_LEAF_CODES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_LEAF_CODES_INL_H
#undef LODESTONE_LEAF_CODES_INL_H
#else
#define LODESTONE_LEAF_CODES_INL_H
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>
#include <span>

#include "lodestone/volumes/leaf_faces.h"
#include "simd/vector_types-inl.h"

// The vertices of a leaf as codes: one bit per boundary that a vertex is beyond. A face whose corners have a bit in
// common is beyond that boundary as a whole.
HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// As many bits as a double has.
using Code_lanes = hn::Rebind<std::uint64_t, Double_lanes>;
using Codes = hn::Vec<Code_lanes>;

/// Lists of vertices are read in whole vectors.
constexpr std::size_t most_codes = 3 * most_leaf_faces + most_double_lanes;

HWY_INLINE void add_bit(Codes& codes, std::size_t bit, Double_mask beyond) {
  const Code_lanes d;
  const auto lanes = hn::RebindMask(d, beyond);
  codes = hn::Or(codes, hn::IfThenElseZero(lanes, hn::Set(d, std::uint64_t{1} << bit)));
}

/// Lists the faces whose corners have no bit in common.
/// @param codes       per vertex of the leaf
/// @param candidates  room for `most_leaf_faces`; indices in the list of faces, ascending
/// @return number of candidates
HWY_INLINE std::size_t list_faces(const Leaf_faces& leaf, const std::uint64_t* codes, std::uint8_t* candidates) {
  // Hoisted: the stores of bytes may alias the list.
  const Leaf_corners* const corners = leaf.corners.data();
  const std::size_t faces = leaf.corners.size();
  std::size_t count = 0;
  for (std::size_t face = 0; face < faces; ++face) {
    const std::uint64_t beyond = codes[corners[face][0]] & codes[corners[face][1]] & codes[corners[face][2]];
    candidates[count] = static_cast<std::uint8_t>(face);
    count += beyond == 0 ? 1 : 0;
  }
  return count;
}

/// Fetches what is read after the vertices, meanwhile.
HWY_INLINE void prefetch(std::span<const Leaf_corners> corners) {
  constexpr std::size_t faces_per_line = 64 / sizeof(Leaf_corners);
  for (std::size_t face = 0; face < corners.size(); face += faces_per_line) hwy::Prefetch(&corners[face]);
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
