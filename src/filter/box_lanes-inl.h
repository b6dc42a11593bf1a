// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_BOX_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_BOX_LANES_INL_H
#undef LODESTONE_BOX_LANES_INL_H
#else
#define LODESTONE_BOX_LANES_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <limits>

#include "filter/face_columns.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Sides of boxes that overlap nothing.
HWY_INLINE Sides padding_low() { return hn::Set(Side_lanes(), std::numeric_limits<std::int16_t>::max()); }
HWY_INLINE Sides padding_high() { return hn::Set(Side_lanes(), std::numeric_limits<std::int16_t>::min()); }

/// Pads columns past the last of `count` faces.
HWY_INLINE void pad_columns(Box_columns& columns, std::size_t count) {
  const Side_lanes d;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    hn::StoreU(padding_low(), d, columns.low[axis] + count);
    hn::StoreU(padding_high(), d, columns.high[axis] + count);
  }
}

/// Stores a vector of boxes from the `start`th on; all past the first `count` become padding.
HWY_INLINE void store_boxes(const Sides (&low)[3], const Sides (&high)[3], std::size_t count, Box_columns& columns,
                            std::size_t start) {
  const Side_lanes d;
  const auto real = hn::FirstN(d, count);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    hn::Store(hn::IfThenElse(real, low[axis], padding_low()), d, columns.low[axis] + start);
    hn::Store(hn::IfThenElse(real, high[axis], padding_high()), d, columns.high[axis] + start);
  }
}

/// One box in every lane, its high sides moved out by the margin.
struct Lane_box {
  Sides low[3], high[3];
};

HWY_INLINE Lane_box lane_box(const Box_columns& columns, std::size_t face) {
  const Side_lanes d;
  const auto side = [&](const Box_columns::Side_column& column) HWY_ATTR { return hn::Set(d, column[face]); };
  return {{side(columns.low[0]), side(columns.low[1]), side(columns.low[2])},
          {side(columns.high[0]), side(columns.high[1]), side(columns.high[2])}};
}

/// The lanes whose boxes, from the `start`th on, overlap a box: they are within the margin of it.
HWY_INLINE hn::Mask<Side_lanes> overlapping(const Lane_box& box, const Box_columns& columns, std::size_t start) {
  const Side_lanes d;
  const auto gap_along = [&](std::size_t axis) HWY_ATTR {
    return hn::Max(hn::SaturatedSub(box.low[axis], hn::LoadU(d, columns.high[axis] + start)),
                   hn::SaturatedSub(hn::LoadU(d, columns.low[axis] + start), box.high[axis]));
  };
  return hn::Lt(hn::Max(hn::Max(gap_along(0), gap_along(1)), gap_along(2)), hn::Set(d, 1));
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
