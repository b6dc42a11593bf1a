// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/ray_depth_kernel.h"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "triangles/ray_depth_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/vector_types-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The questions, or as many of them as a vector holds.
using Lanes = hn::CappedTag<double, most_depth_questions>;
/// A single question. To read numbers that have just been written one by one with one vector load would stall.
using One_lane = hn::CappedTag<double, 1>;
/// So few questions are answered one by one.
constexpr std::size_t few_questions = 2;

/// Some of the questions, as many as a vector holds or as are left.
template <class Tag>
class Questions {
 public:
  Questions(std::size_t first, std::size_t count) : first_(first), asked_(hn::FirstN(Tag(), count - first)) {}

  /// Those that are not asked are 0.
  HWY_INLINE hn::Vec<Tag> load(const double* numbers) const {
    if constexpr (hn::MaxLanes(Tag()) == 1) return hn::Load(Tag(), numbers + first_);
    return hn::MaskedLoad(asked_, Tag(), numbers + first_);
  }
  std::size_t first() const { return first_; }

 private:
  std::size_t first_;
  hn::Mask<Tag> asked_;
};

/// The corners of triangles in the coordinates of their rays, and the sizes of what was computed.
template <class Tag>
struct Seen {
  hn::Vec<Tag> x[3], y[3], depth[3];
  hn::Vec<Tag> reach, size;
};

template <class Tag>
HWY_INLINE Seen<Tag> see(const Depth_questions& questions, const Questions<Tag>& some) {
  using Values = hn::Vec<Tag>;
  const Values shear_x = some.load(questions.shear[0]), shear_y = some.load(questions.shear[1]);
  const Values sign = some.load(questions.sign);
  Seen<Tag> seen;
  seen.reach = seen.size = hn::Zero(Tag());
  for (int c = 0; c < 3; ++c) {
    const Values x = some.load(questions.x[c]), y = some.load(questions.y[c]), z = some.load(questions.z[c]);
    seen.x[c] = hn::Sub(x, hn::Mul(shear_x, z));
    seen.y[c] = hn::Sub(y, hn::Mul(shear_y, z));
    seen.depth[c] = hn::Mul(sign, z);
    seen.reach = hn::Max(seen.reach, greatest(hn::Abs(x), hn::Abs(y), hn::Abs(z)));
    seen.size = greatest(seen.size, hn::Abs(seen.x[c]), hn::Abs(seen.y[c]));
  }
  return seen;
}

template <class Tag>
HWY_INLINE hn::Vec<Tag> cross(const Seen<Tag>& seen, int a, int b) {
  return hn::Sub(hn::Mul(seen.x[a], seen.y[b]), hn::Mul(seen.x[b], seen.y[a]));
}

/// A weight of a corner is the cross product of the positions of the other two. With positions of size r at most, and
/// with errors of e each, it has an error of 4 e r + 2 e^2, and 5 u r^2 from rounding. As r is at most 2 m + e, and e
/// is 8 u m, this is below 8 e (r + e). If all three weights have the same sign beyond it, the ray passes through the
/// interior. If two have opposite signs, it misses the triangle.
///
/// With errors of w each, the weights relative to their sum s are wrong by 6 w / s in total, so the depth is wrong by
/// at most 3 w / s of the range of depths, and by some roundings of the largest.
template <class Tag>
HWY_INLINE void estimate_some(Tag d, const Depth_questions& questions, const Questions<Tag>& some,
                              Depth_estimates& estimates) {
  using Values = hn::Vec<Tag>;
  const auto number = [](double x) HWY_ATTR { return hn::Set(Tag(), x); };
  const Values zero = hn::Zero(d), endless = number(std::numeric_limits<double>::infinity());
  const Values tiny = number(error_of_underflow), eight_roundings = number(0x1p-50);
  const Seen<Tag> seen = see(questions, some);
  const auto is_precise = hn::Lt(seen.reach, number(most_reach));
  const Values error = hn::Add(hn::Mul(number(error_per_reach), seen.reach), tiny);  // see `frame_error`

  const Values nearest = least(seen.depth[0], seen.depth[1], seen.depth[2]);
  const Values farthest = greatest(seen.depth[0], seen.depth[1], seen.depth[2]);
  const Values largest = hn::Max(hn::Abs(nearest), hn::Abs(farthest));
  const Values most_limit = some.load(questions.most_limit);
  const auto out_of_reach =
      hn::Or(hn::Lt(farthest, zero), hn::Gt(nearest, most_limit));  // one rounding changes neither

  const Values weights[]{cross(seen, 1, 2), cross(seen, 2, 0), cross(seen, 0, 1)};
  const Values weight_error = hn::Add(hn::Mul(hn::Mul(number(8), error), hn::Add(seen.size, error)), tiny);
  const Values low = least(weights[0], weights[1], weights[2]), high = greatest(weights[0], weights[1], weights[2]);
  const auto beside = hn::And(hn::Lt(low, hn::Neg(weight_error)), hn::Gt(high, weight_error));
  const auto through = hn::Or(hn::Gt(low, weight_error), hn::Lt(high, hn::Neg(weight_error)));

  const Values sum = hn::Add(hn::Add(weights[0], weights[1]), weights[2]);
  const auto part = [&](int c)
                        HWY_ATTR { return hn::Mul(hn::Div(weights[c], sum), hn::Sub(seen.depth[c], seen.depth[0])); };
  const Values middle = hn::Add(hn::Add(seen.depth[0], part(1)), part(2));
  const Values of_weights =
      hn::Mul(hn::Mul(number(4), hn::Div(weight_error, hn::Abs(sum))), hn::Sub(farthest, nearest));
  const Values of_depths = hn::Mul(hn::Mul(number(4), eight_roundings), largest);
  const Values depth_error = hn::Add(hn::Add(of_weights, of_depths), tiny);

  // Where floating point does not know whether the ray passes through, the depth is somewhere between the corners'.
  const Values margin = hn::Mul(eight_roundings, largest);
  Values from = hn::Sub(nearest, margin), to = hn::Add(farthest, margin);
  from = hn::IfThenElse(through, hn::Max(from, hn::Sub(middle, depth_error)), from);
  to = hn::IfThenElse(through, hn::Min(to, hn::Add(middle, depth_error)), to);
  const auto misses =
      hn::Or(hn::Or(out_of_reach, beside), hn::And(through, hn::Or(hn::Lt(to, zero), hn::Gt(from, most_limit))));
  const auto meets = hn::And(through, hn::And(hn::Ge(from, zero), hn::Le(to, some.load(questions.least_limit))));
  const std::size_t first = some.first();
  hn::Store(hn::IfThenElse(is_precise, from, hn::Neg(endless)), d, estimates.low + first);
  hn::Store(hn::IfThenElse(is_precise, to, endless), d, estimates.high + first);
  estimates.misses |= mask_bits(d, hn::And(is_precise, misses)) << first;
  estimates.meets |= mask_bits(d, hn::And(is_precise, hn::AndNot(misses, meets))) << first;
}

template <class Tag>
HWY_INLINE void estimate_all(Tag d, const Depth_questions& questions, std::size_t count, Depth_estimates& estimates) {
  for (std::size_t first = 0; first < count; first += hn::MaxLanes(d))
    estimate_some(d, questions, Questions<Tag>(first, count), estimates);
}

void estimate_depths_kernel(const Depth_questions& questions, std::size_t count, Depth_estimates& estimates) {
  estimates.misses = estimates.meets = 0;
  if (count <= few_questions)
    estimate_all(One_lane(), questions, count, estimates);
  else
    estimate_all(Lanes(), questions, count, estimates);
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lodestone::kernel {

HWY_EXPORT(estimate_depths_kernel);

void estimate_depths(const Depth_questions& questions, std::size_t count, Depth_estimates& estimates) {
  HWY_DYNAMIC_DISPATCH(estimate_depths_kernel)(questions, count, estimates);
}

}  // namespace lodestone::kernel
#endif
