// SPDX-License-Identifier: GPL-3.0-or-later
// Without GMP, CGAL's exact numbers are quotients of Boost's integers. CGAL 5.5 makes them from doubles by doubling
// until there is no fraction, where the denominator overflows for subnormal numbers. Here it is a power of two of any
// size.
#pragma once

#include_next <CGAL/boost_mp.h>

#include <cmath>
#include <cstdint>

namespace CGAL {

template <>
struct Split_double<boost::multiprecision::cpp_int> {
  void operator()(double number, boost::multiprecision::cpp_int& numerator,
                  boost::multiprecision::cpp_int& denominator) const {
    int exponent = 0;
    constexpr int bits = 53;
    numerator = static_cast<std::int64_t>(std::ldexp(std::frexp(number, &exponent), bits));
    denominator = 1;
    exponent -= bits;
    if (exponent >= 0)
      numerator <<= exponent;
    else
      denominator <<= -exponent;
    const boost::multiprecision::cpp_int common = gcd(numerator, denominator);  // `auto` would be an expression
    numerator /= common;
    denominator /= common;
  }
};

}  // namespace CGAL
