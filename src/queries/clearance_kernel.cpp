// SPDX-License-Identifier: GPL-3.0-or-later
#include "queries/clearance_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "queries/clearance_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

static_assert(faces_per_step % double_lanes == 0 && most_leaf_faces % faces_per_step == 0);

Span span_faces_kernel(const Corner_columns& corners, const double (&axes)[3][3], Face_spans& spans) {
  const Double_lanes d;
  const Vector3<Double_lanes> along[]{in_all_lanes(d, axes[0]), in_all_lanes(d, axes[1]), in_all_lanes(d, axes[2])};
  for (std::size_t i = 0; i < corners.count; i += double_lanes) {
    const auto corner = [&](std::size_t c) HWY_ATTR {
      const double* const x = corners.numbers + 3 * c * corners.stride + i;
      return Vector3<Double_lanes>{hn::LoadU(d, x), hn::LoadU(d, x + corners.stride),
                                   hn::LoadU(d, x + 2 * corners.stride)};
    };
    const Vector3<Double_lanes> p = corner(0), q = corner(1), r = corner(2);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Doubles at_p = dot(along[axis], p), at_q = dot(along[axis], q), at_r = dot(along[axis], r);
      hn::StoreU(hn::Min(hn::Min(at_p, at_q), at_r), d, spans.low[axis] + i);
      hn::StoreU(hn::Max(hn::Max(at_p, at_q), at_r), d, spans.high[axis] + i);
    }
  }
  spans.count = corners.count;
  for (std::size_t i = 0; i < spans.count; ++i) spans.faces[i] = static_cast<std::uint8_t>(i);
  Span all;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Padding repeats the last face.
    Doubles low = hn::LoadU(d, spans.low[axis]), high = hn::LoadU(d, spans.high[axis]);
    for (std::size_t i = double_lanes; i < corners.count; i += double_lanes) {
      low = hn::Min(low, hn::LoadU(d, spans.low[axis] + i));
      high = hn::Max(high, hn::LoadU(d, spans.high[axis] + i));
    }
    all.low[axis] = hn::GetLane(hn::MinOfLanes(d, low));
    all.high[axis] = hn::GetLane(hn::MaxOfLanes(d, high));
  }
  return all;
}

/// `In_line`, in all lanes.
class Test {
 public:
  explicit Test(const In_line& rule)
      : slack_{hn::Set(Double_lanes(), rule.slack[0]), hn::Set(Double_lanes(), rule.slack[1])},
        least_(hn::Set(Double_lanes(), rule.least)) {}

  /// @param low, high  called with an axis
  template <class Low_a, class High_a, class Low_b, class High_b>
  HWY_INLINE std::uint32_t operator()(const Low_a& low_a, const High_a& high_a, const Low_b& low_b,
                                      const High_b& high_b) const {
    auto in_line = hn::Ge(hn::Sub(high_b(2), low_a(2)), least_);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      in_line = hn::And(in_line, hn::Le(hn::Sub(low_b(axis), high_a(axis)), slack_[axis]));
      in_line = hn::And(in_line, hn::Le(hn::Sub(low_a(axis), high_b(axis)), slack_[axis]));
    }
    return mask_bits(Double_lanes(), in_line);
  }

 private:
  Doubles slack_[2], least_;
};

/// One number per axis, in all lanes.
HWY_INLINE auto in_lanes(const double (&numbers)[3]) {
  const Double_lanes d;
  const Doubles x = hn::Set(d, numbers[0]), y = hn::Set(d, numbers[1]), z = hn::Set(d, numbers[2]);
  return [x, y, z](std::size_t axis) HWY_ATTR { return axis == 0 ? x : axis == 1 ? y : z; };
}
/// Those of some faces from the i-th on.
HWY_INLINE auto column(const double (&numbers)[3][most_leaf_faces], std::size_t i) {
  return [&numbers, i](std::size_t axis) HWY_ATTR { return hn::LoadU(Double_lanes(), numbers[axis] + i); };
}

/// Drops the faces whose bits are not set.
/// @param bits  called with the first face of each vector
template <class Bits>
HWY_INLINE void keep(Face_spans& spans, const Bits& bits) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < spans.count; i += double_lanes) {
    std::uint32_t left = bits(i);
    for (; left != 0; left &= left - 1) {
      const std::size_t face = i + hwy::Num0BitsBelowLS1Bit_Nonzero32(left);
      if (face >= spans.count) break;
      spans.faces[kept] = spans.faces[face];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        spans.low[axis][kept] = spans.low[axis][face];
        spans.high[axis][kept] = spans.high[axis][face];
      }
      ++kept;
    }
  }
  spans.count = kept;
}

void keep_of_a_kernel(Face_spans& a, const Span& b, const In_line& rule) {
  const Test test(rule);
  const auto low = in_lanes(b.low), high = in_lanes(b.high);
  keep(a, [&](std::size_t i) HWY_ATTR { return test(column(a.low, i), column(a.high, i), low, high); });
}

void keep_of_b_kernel(const Span& a, Face_spans& b, const In_line& rule) {
  const Test test(rule);
  const auto low = in_lanes(a.low), high = in_lanes(a.high);
  keep(b, [&](std::size_t i) HWY_ATTR { return test(low, high, column(b.low, i), column(b.high, i)); });
}

std::size_t list_in_line_kernel(const Face_spans& a, const Face_spans& b, const In_line& rule, Face_slots* pairs) {
  const Test test(rule);
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.count; ++i) {
    const double low_of_one[]{a.low[0][i], a.low[1][i], a.low[2][i]};
    const double high_of_one[]{a.high[0][i], a.high[1][i], a.high[2][i]};
    const auto low = in_lanes(low_of_one), high = in_lanes(high_of_one);
    for (std::size_t j = 0; j < b.count; j += double_lanes) {
      std::uint32_t left = test(low, high, column(b.low, j), column(b.high, j));
      for (; left != 0; left &= left - 1) {
        const std::size_t face = j + hwy::Num0BitsBelowLS1Bit_Nonzero32(left);
        if (face >= b.count) break;
        pairs[count++] = {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(face)};
      }
    }
  }
  return count;
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(span_faces_kernel);
HWY_EXPORT(keep_of_a_kernel);
HWY_EXPORT(keep_of_b_kernel);
HWY_EXPORT(list_in_line_kernel);

Span span_faces(const Corner_columns& corners, const double (&axes)[3][3], Face_spans& spans) {
  return HWY_DYNAMIC_DISPATCH(span_faces_kernel)(corners, axes, spans);
}

void keep_in_line_with(Face_spans& a, const Span& b, const In_line& rule) {
  HWY_DYNAMIC_DISPATCH(keep_of_a_kernel)(a, b, rule);
}

void keep_in_line_with(const Span& a, Face_spans& b, const In_line& rule) {
  HWY_DYNAMIC_DISPATCH(keep_of_b_kernel)(a, b, rule);
}

std::size_t list_in_line(const Face_spans& a, const Face_spans& b, const In_line& rule, Face_slots* pairs) {
  return HWY_DYNAMIC_DISPATCH(list_in_line_kernel)(a, b, rule, pairs);
}

}  // namespace lodestone::kernel
#endif
