// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <type_traits>

namespace lodestone {

/// Calls `function` with the number of components k as a compile-time constant if k is a usual one, otherwise with 0.
/// Inner loops over a constant k are unrolled.
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

/// Squared distance, summed from the first component to the last. The order is the same for every caller, so equal
/// inputs give equal bits. K is the number of components; 0: it is `k`.
template <int K>
double squared_distance(const double* a, const double* b, std::ptrdiff_t k) {
  double sum = 0;
  for (std::ptrdiff_t i = 0; i < (K > 0 ? K : k); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

}  // namespace lodestone
