// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_ROUNDING_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_ROUNDING_INL_H
#undef LODESTONE_ROUNDING_INL_H
#else
#define LODESTONE_ROUNDING_INL_H
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <limits>

#include "filter/face_columns.h"
#include "filter/face_filter_kernel.h"
#include "lodestone/volumes/aabb.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Coordinates of a leaf are rounded to floats, and sides of boxes to steps of 16 bits: a vector holds more of them than
// doubles. What is proven about the rounded ones allows for what rounding lost.

/// Coordinates in the request's unit, as seen from its origin, rounded to floats. Rounding is monotonic.
template <class Tag>
HWY_INLINE hn::Vec<hn::Rebind<float, Tag>> rounded(Tag d, const Filter_request& request, hn::Vec<Tag> origin,
                                                   hn::Vec<Tag> coordinates) {
  const auto most = hn::Set(d, static_cast<double>(std::numeric_limits<float>::max()));
  const auto scaled = hn::Mul(hn::Sub(coordinates, origin), hn::Set(d, request.scale));
  return hn::DemoteTo(hn::Rebind<float, Tag>(), hn::Min(hn::Max(scaled, hn::Neg(most)), most));
}

/// The steps that rounded coordinates are in; those outside the request's region are in its first or last step.
///
/// Rounding and stepping are monotonic: boxes within the margin of each other stay so, however much is lost.
template <class Tag>
HWY_INLINE hn::Vec<hn::Rebind<std::int16_t, Tag>> steps(Tag d, hn::Vec<Tag> coordinates, hn::Vec<Tag> per_unit) {
  const hn::Rebind<std::int32_t, Tag> integers;
  const auto inside = hn::Min(hn::Max(hn::Mul(coordinates, per_unit), hn::Zero(d)), hn::Set(d, most_steps));
  return hn::DemoteTo(hn::Rebind<std::int16_t, Tag>(),
                      hn::Add(hn::ConvertTo(integers, inside), hn::Set(integers, first_step)));
}

/// Steps of one corner of a box, moved by `shift`.
HWY_INLINE void step_corner(const Filter_request& request, double shift, const double* corner, std::int16_t* to) {
  const Position_lanes d;
  const hn::Rebind<float, Position_lanes> narrow;
  for (std::size_t i = 0; i < 4; i += position_lanes) {
    const auto moved = hn::Add(hn::LoadU(d, corner + i), hn::Set(d, shift));
    const auto position = rounded(d, request, hn::LoadU(d, request.origin + i), moved);
    const auto per_unit = hn::LoadU(narrow, request.steps_per_unit + i);
    hn::StoreU(steps(narrow, position, per_unit), hn::Rebind<std::int16_t, Position_lanes>(), to + i);
  }
}

/// What bounds the loss by rounding the corners of two leaves.
struct Rounding {
  float largest[4] = {};  ///< by axis, the largest |coordinate| within the boxes of the leaves
  float margin;

  HWY_INLINE Rounding(const Filter_request& request, const Aabb& a, const Aabb& b) : margin(request.rounded_margin) {
    const Position_lanes d;
    for (std::size_t i = 0; i < 4; i += position_lanes) {
      const auto origin = hn::LoadU(d, request.origin + i);
      const auto distance = [&](const double* corner)
                                HWY_ATTR { return hn::Abs(hn::Sub(hn::Load(d, corner + i), origin)); };
      const auto farthest =
          hn::Max(hn::Max(distance(a.low), distance(a.high)), hn::Max(distance(b.low), distance(b.high)));
      hn::StoreU(rounded(d, request, hn::Zero(d), farthest), hn::Rebind<float, Position_lanes>(), largest + i);
    }
  }
};

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
