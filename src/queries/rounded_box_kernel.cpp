// SPDX-License-Identifier: GPL-3.0-or-later
#include "queries/rounded_box_kernel.h"

#include <cstdint>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "queries/rounded_box_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/positions-inl.h"
#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The eight numbers of a Rounded_box: one vector of eight lanes, or several with fewer.
using Box_lanes = hn::CappedTag<float, 8>;
using Box_vector = hn::Vec<Box_lanes>;
constexpr std::size_t box_lanes = hn::MaxLanes(Box_lanes());
constexpr std::size_t box_vectors = 8 / box_lanes;
/// The bits of the six sides.
constexpr std::uint32_t all_sides = 0x77;

/// A box around nothing.
constexpr Rounded_box nothing = [] {
  constexpr float most = std::numeric_limits<float>::max();
  return Rounded_box{.low = {most, most, most}, .index = 0, .negated_high = {most, most, most}, .unused = 0};
}();

HWY_INLINE Box_vector load(const Rounded_box& box, std::size_t i) {
  return hn::Load(Box_lanes(), reinterpret_cast<const float*>(&box) + i * box_lanes);
}
HWY_INLINE void store(Box_vector numbers, Rounded_box& box, std::size_t i) {
  hn::Store(numbers, Box_lanes(), reinterpret_cast<float*>(&box) + i * box_lanes);
}
HWY_INLINE void copy(const Rounded_box& from, Rounded_box& to) {
  for (std::size_t i = 0; i < box_vectors; ++i) store(load(from, i), to, i);
}

/// 1 or 0, of which the compiler does not know that it is a condition: it would branch on it.
HWY_INLINE std::uint32_t as_number(bool condition) {
  std::uint32_t number = condition ? 1 : 0;
#if defined(__GNUC__)
  asm("" : "+r"(number));
#endif
  return number;
}

/// A box that grows around others.
class Growing {
 public:
  HWY_INLINE Growing() {
    for (std::size_t i = 0; i < box_vectors; ++i) least_[i] = load(nothing, i);
  }
  /// Branchless, since which boxes are added is unpredictable.
  HWY_INLINE void add_if(std::uint32_t added, const Rounded_box& box) {
    const Box_lanes d;
    const hn::RebindToSigned<Box_lanes> bits;
    const auto all = hn::MaskFromVec(hn::BitCast(d, hn::Set(bits, -static_cast<std::int32_t>(added))));
    for (std::size_t i = 0; i < box_vectors; ++i)
      least_[i] = hn::Min(least_[i], hn::IfThenElse(all, load(box, i), load(nothing, i)));
  }
  HWY_INLINE Rounded_box box() const {
    Rounded_box around;
    for (std::size_t i = 0; i < box_vectors; ++i) store(least_[i], around, i);
    return around;
  }

 private:
  Box_vector least_[box_vectors];
};

/// What the numbers of a box must not exceed if it meets another.
class Meets_box {
 public:
  HWY_INLINE explicit Meets_box(const Rounded_box& other) {
    Rounded_box greatest{};
    for (int axis = 0; axis < 3; ++axis) {
      greatest.low[axis] = -other.negated_high[axis];
      greatest.negated_high[axis] = -other.low[axis];
    }
    for (std::size_t i = 0; i < box_vectors; ++i) greatest_[i] = load(greatest, i);
  }
  HWY_INLINE bool with(const Rounded_box& box) const {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < box_vectors; ++i)
      bits |= mask_bits(Box_lanes(), hn::Le(load(box, i), greatest_[i])) << (i * box_lanes);
    return (bits & all_sides) == all_sides;
  }

 private:
  Box_vector greatest_[box_vectors];
};

using Narrow_lanes = hn::Rebind<float, Position_lanes>;

/// Moves vector `i` of a position into the region that is rounded, and rounds it.
HWY_INLINE hn::Vec<Narrow_lanes> rounded(const Box_rounding& rounding, Position_vector position, std::size_t i) {
  const Position_lanes d;
  const auto scaled = hn::Mul(position, hn::Set(d, rounding.scale));
  const auto moved = hn::Sub(scaled, hn::LoadU(d, rounding.origin + i * position_lanes));
  const auto inside = hn::Min(hn::Max(moved, hn::Zero(d)), hn::LoadU(d, rounding.size + i * position_lanes));
  return hn::DemoteTo(Narrow_lanes(), inside);
}

/// The numbers of a box around one face, or around several: those of `low`, then those of `negated_high`.
struct Rounded_sides {
  hn::Vec<Narrow_lanes> low[position_vectors], negated_high[position_vectors];
};

HWY_INLINE Rounded_sides sides_of_face(const double* coordinates, const Face_corners& corners,
                                       const Box_rounding& rounding) {
  Rounded_sides sides;
  for (std::size_t i = 0; i < position_vectors; ++i) {
    const auto p = load_position(coordinates + 3 * std::size_t{corners[0]}, i);
    const auto q = load_position(coordinates + 3 * std::size_t{corners[1]}, i);
    const auto r = load_position(coordinates + 3 * std::size_t{corners[2]}, i);
    sides.low[i] = rounded(rounding, hn::Min(hn::Min(p, q), r), i);
    sides.negated_high[i] = hn::Neg(rounded(rounding, hn::Max(hn::Max(p, q), r), i));
  }
  return sides;
}

HWY_INLINE void store(const Rounded_sides& sides, std::uint32_t index, Rounded_box& box) {
  const Narrow_lanes d;
  for (std::size_t i = 0; i < position_vectors; ++i) {
    hn::StoreU(sides.low[i], d, reinterpret_cast<float*>(&box) + i * position_lanes);
    hn::StoreU(sides.negated_high[i], d, reinterpret_cast<float*>(&box) + 4 + i * position_lanes);
  }
  box.index = index;
}

Rounded_box box_faces_kernel(const double* coordinates, const Face_corners* corners, std::size_t count,
                             const Box_rounding& rounding, Rounded_box* boxes) {
  const Narrow_lanes d;
  Rounded_sides around;
  for (std::size_t i = 0; i < position_vectors; ++i)
    around.low[i] = around.negated_high[i] = hn::Set(d, std::numeric_limits<float>::max());
  for (std::size_t face = 0; face < count; ++face) {
    const Rounded_sides sides = sides_of_face(coordinates, corners[face], rounding);
    // A box that has just been written in parts is slow to read as a whole.
    for (std::size_t i = 0; i < position_vectors; ++i) {
      around.low[i] = hn::Min(around.low[i], sides.low[i]);
      around.negated_high[i] = hn::Min(around.negated_high[i], sides.negated_high[i]);
    }
    store(sides, static_cast<std::uint32_t>(face), boxes[face]);
  }
  Rounded_box box;
  store(around, 0, box);
  return box;
}

std::size_t cull_kernel(const Rounded_box* from, std::size_t count, const Rounded_box& other, Rounded_box* to,
                        Rounded_box& around) {
  const Meets_box meets_other(other);
  Growing growing;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t meets = as_number(meets_other.with(from[i]));
    growing.add_if(meets, from[i]);
    copy(from[i], to[kept]);
    kept += meets;
  }
  around = growing.box();
  return kept;
}

Halves split_kernel(Rounded_box* from, std::size_t count, int axis, float twice_at, Rounded_box* to) {
  Halves halves;
  Growing below, above;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t is_below = as_number(from[i].low[axis] - from[i].negated_high[axis] < twice_at);
    below.add_if(is_below, from[i]);
    above.add_if(1 - is_below, from[i]);
    copy(from[i], to[halves.below]);
    copy(from[i], from[halves.above]);
    halves.below += is_below;
    halves.above += 1 - is_below;
  }
  halves.around_below = below.box();
  halves.around_above = above.box();
  return halves;
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(box_faces_kernel);
HWY_EXPORT(cull_kernel);
HWY_EXPORT(split_kernel);

Rounded_box box_faces(const double* coordinates, const Face_corners* corners, std::size_t count,
                      const Box_rounding& rounding, Rounded_box* boxes) {
  return HWY_DYNAMIC_DISPATCH(box_faces_kernel)(coordinates, corners, count, rounding, boxes);
}
std::size_t cull(const Rounded_box* from, std::size_t count, const Rounded_box& other, Rounded_box* to,
                 Rounded_box& around) {
  return HWY_DYNAMIC_DISPATCH(cull_kernel)(from, count, other, to, around);
}
Halves split(Rounded_box* from, std::size_t count, int axis, float twice_at, Rounded_box* to) {
  return HWY_DYNAMIC_DISPATCH(split_kernel)(from, count, axis, twice_at, to);
}

}  // namespace lodestone::kernel
#endif
