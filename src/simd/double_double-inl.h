// SPDX-License-Identifier: GPL-3.0-or-later
// Included once per instruction set, as Highway's own *-inl.h files are.
#if defined(LODESTONE_DOUBLE_DOUBLE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LODESTONE_DOUBLE_DOUBLE_INL_H
#undef LODESTONE_DOUBLE_DOUBLE_INL_H
#else
#define LODESTONE_DOUBLE_DOUBLE_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lodestone::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// In each lane the unevaluated sum of two doubles, `low` at most half of the last digit of `high`: some 106 bits.
///
/// Without overflow, and for products beyond 2^-900 without underflow, the absolute error of a result is at most
///  - 2^-103 (|a| + |b|) for a + b and a - b,
///  - 2^-101 |a b| for a b,
///  - 2^-99 |a / b| for a / b.
/// The operations are those of \cite knuth1969 and \cite dekker1971. They give the same bits on every instruction set.
template <class Vector>
struct Double_double {
  Vector high, low;
};

/// a + b without any error.
template <class Vector>
HWY_INLINE Double_double<Vector> exact_sum(Vector a, Vector b) {
  const Vector sum = hn::Add(a, b), of_b = hn::Sub(sum, a);
  return {sum, hn::Add(hn::Sub(a, hn::Sub(sum, of_b)), hn::Sub(b, of_b))};
}
/// a - b without any error.
template <class Vector>
HWY_INLINE Double_double<Vector> exact_difference(Vector a, Vector b) {
  const Vector difference = hn::Sub(a, b), of_b = hn::Sub(difference, a);
  return {difference, hn::Sub(hn::Sub(a, hn::Sub(difference, of_b)), hn::Add(b, of_b))};
}
/// a + b without any error, for |a| >= |b| or a = 0.
template <class Vector>
HWY_INLINE Double_double<Vector> exact_sum_of_ordered(Vector a, Vector b) {
  const Vector sum = hn::Add(a, b);
  return {sum, hn::Sub(b, hn::Sub(sum, a))};
}

/// a b without any error.
template <class Vector>
HWY_INLINE Double_double<Vector> exact_product(Vector a, Vector b) {
  const Vector product = hn::Mul(a, b);
#if HWY_NATIVE_FMA
  return {product, hn::MulSub(a, b, product)};
#else
  // Halves of 26 bits each, so that their products are exact.
  const auto upper = [](Vector x) {
    const Vector large = hn::Mul(hn::Set(hn::DFromV<Vector>(), 0x1p27 + 1), x);
    return hn::Sub(large, hn::Sub(large, x));
  };
  const Vector a1 = upper(a), a2 = hn::Sub(a, a1), b1 = upper(b), b2 = hn::Sub(b, b1);
  const Vector rest = hn::Add(hn::Add(hn::Sub(hn::Mul(a1, b1), product), hn::Mul(a1, b2)), hn::Mul(a2, b1));
  return {product, hn::Add(rest, hn::Mul(a2, b2))};
#endif
}

template <class Vector>
HWY_INLINE Double_double<Vector> operator+(const Double_double<Vector>& a, const Double_double<Vector>& b) {
  const auto sum = exact_sum(a.high, b.high);
  return exact_sum_of_ordered(sum.high, hn::Add(sum.low, hn::Add(a.low, b.low)));
}
template <class Vector>
HWY_INLINE Double_double<Vector> operator-(const Double_double<Vector>& a, const Double_double<Vector>& b) {
  const auto difference = exact_difference(a.high, b.high);
  return exact_sum_of_ordered(difference.high, hn::Add(difference.low, hn::Sub(a.low, b.low)));
}
template <class Vector>
HWY_INLINE Double_double<Vector> operator*(const Double_double<Vector>& a, const Double_double<Vector>& b) {
  const auto product = exact_product(a.high, b.high);
  const Vector mixed = hn::Add(hn::Mul(a.high, b.low), hn::Mul(a.low, b.high));
  return exact_sum_of_ordered(product.high, hn::Add(product.low, mixed));
}
template <class Vector>
HWY_INLINE Double_double<Vector> operator/(const Double_double<Vector>& a, const Double_double<Vector>& b) {
  const Vector quotient = hn::Div(a.high, b.high), zero = hn::Sub(quotient, quotient);
  const auto rest = a - Double_double<Vector>{quotient, zero} * b;
  return exact_sum_of_ordered(quotient, hn::Div(rest.high, b.high));
}

}  // namespace lodestone::kernel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
