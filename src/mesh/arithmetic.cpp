// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/arithmetic.h"

#include <cfenv>
#include <limits>

#include "lodestone/mesh/errors.h"

#if defined(__SSE2__) && !defined(__EMSCRIPTEN__)
#include <emmintrin.h>
#endif

namespace lodestone {

namespace {

#if defined(__SSE2__) && !defined(__EMSCRIPTEN__)

// The control register tells it. To try it with subnormal numbers takes some processors a hundred times as long.
bool rounds_to_nearest() { return (_mm_getcsr() & 0x6000U) == 0; }
bool knows_subnormal_numbers() { return (_mm_getcsr() & 0x8040U) == 0; }

#else

bool rounds_to_nearest() { return std::fegetround() == FE_TONEAREST; }

bool knows_subnormal_numbers() {
  volatile double least_normal = std::numeric_limits<double>::min(), half = 0.5, twice = 2;
  const volatile double subnormal = least_normal * half;
  return subnormal * twice == least_normal;
}

#endif

}  // namespace

void check_arithmetic() {
  if (!rounds_to_nearest())
    throw Bad_argument("this thread does not round to nearest: exact answers rest on that (see std::fesetround)");
  if (!knows_subnormal_numbers())
    throw Bad_argument(
        "this thread takes subnormal numbers for zero: exact answers rest on them (turn off flush-to-zero and "
        "denormals-are-zero)");
}

}  // namespace lodestone
