// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_LANE_LOOKUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_LANE_LOOKUP_INL_H
#undef LODESTONE_LANE_LOOKUP_INL_H
#else
#define LODESTONE_LANE_LOOKUP_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "contact/near_boxes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// As many rounded coordinates as a vector holds.
using Float_lanes = hn::Rebind<float, Vertex_lanes>;
using Floats = hn::Vec<Float_lanes>;

/// Coordinates of the corners of a face per lane, by axis and corner.
struct Corner_coordinates {
  Floats of[3][3];
};

#if HWY_TARGET <= HWY_AVX3
/// A place in a column per lane.
class Lane_places {
 public:
  explicit HWY_INLINE Lane_places(hn::Vec<Vertex_lanes> places)
      : lane_(hn::And(places, hn::Set(Vertex_lanes(), hn::MaxLanes(Vertex_lanes()) - 1))),
        block_(hn::Sub(places, lane_)) {}

  /// What is at these places if they are in the block of the column that starts at `start`, else `other`. A block is a
  /// vector, and is looked up in a register.
  template <class T>
  HWY_INLINE hn::Vec<hn::Rebind<T, Vertex_lanes>> look_up(const T* column, std::size_t start,
                                                          hn::Vec<hn::Rebind<T, Vertex_lanes>> other) const {
    const hn::Rebind<T, Vertex_lanes> d;
    const auto here = hn::RebindMask(d, hn::Eq(block_, hn::Set(Vertex_lanes(), static_cast<std::uint32_t>(start))));
    const auto found = hn::TableLookupLanes(hn::Load(d, column + start), hn::IndicesFromVec(d, lane_));
    return hn::IfThenElse(here, found, other);
  }

 private:
  hn::Vec<Vertex_lanes> lane_, block_;
};

/// @param corners  places of vertices, by corner
HWY_INLINE Corner_coordinates look_up_corners(const Face_columns::Positions& positions, std::size_t vertex_count,
                                              const hn::Vec<Vertex_lanes> (&corners)[3]) {
  const Lane_places places[]{Lane_places(corners[0]), Lane_places(corners[1]), Lane_places(corners[2])};
  Corner_coordinates coordinates;
  for (auto& of_axis : coordinates.of)
    for (auto& of_corner : of_axis) of_corner = hn::Zero(Float_lanes());
  for (std::size_t start = 0; start < vertex_count; start += hn::MaxLanes(Float_lanes()))
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (std::size_t axis = 0; axis < 3; ++axis)
        coordinates.of[axis][corner] = places[corner].look_up(positions[axis], start, coordinates.of[axis][corner]);
  return coordinates;
}
#endif

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
