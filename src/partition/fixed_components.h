// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <type_traits>

namespace lodestone {

/// Calls `function` with the number of components k as a compile-time constant where it is one of the usual ones, and
/// with 0 elsewhere: inner loops over a known k unroll.
template <class Function>
auto with_fixed_components(std::ptrdiff_t k, Function function) {
  switch (k) {
    case 3:
      return function(std::integral_constant<int, 3>());
    case 6:
      return function(std::integral_constant<int, 6>());
    case 7:
      return function(std::integral_constant<int, 7>());
    default:
      return function(std::integral_constant<int, 0>());
  }
}

/// Squared distance, summed from the first component to the last: one order for every caller, so that equal inputs give
/// equal bits. K is the number of components, or 0 for `k`.
template <int K>
double squared_distance(const double* a, const double* b, std::ptrdiff_t k) {
  double sum = 0;
  for (std::ptrdiff_t i = 0; i < (K > 0 ? K : k); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

}  // namespace lodestone
