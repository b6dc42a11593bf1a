// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/volumes/k_dop.h"

#include <algorithm>

#include "lodestone/volumes/bounding_volume.h"
#include "volumes/infinity.h"
#include "volumes/slab_kernel.h"
#include "volumes/slab_polytope.h"

namespace lodestone {

static_assert(Bounding_volume<K_dop<14>> && Bounding_volume<K_dop<18>> && Bounding_volume<K_dop<26>>);

namespace {

/// Moves limits outwards so far that what rounded to numbers between them lies between them.
///
/// Let R be the sum of the largest |x|, |y| and |z|, and u = 2^-53. A sum of two numbers is off by at most u of its
/// size, so one of three, whose parts are at most R (1 + u), by at most 2 u (1 + u) R; the subtraction of the slack
/// rounds once more, by at most u (1 + 8 u) R. R itself is computed to 2 u, and a slack of 8 u R is far more than these
/// 3.1 u R. Sums below 2^-1021 do not round, and above that the slack is at least 2^-1072, off by an eighth at most.
void widen(double* low, double* high, int slabs) {
  double reach = 0;
  for (int i = 0; i < 3; ++i) reach += std::max(-low[i], high[i]);
  const bool bounded = reach < 1e307;
  const double slack = 0x1p-50 * reach;
  for (int i = 3; i < slabs; ++i) {
    low[i] = bounded ? low[i] - slack : -infinity;
    high[i] = bounded ? high[i] + slack : infinity;
  }
}

}  // namespace

template <int K>
void K_dop<K>::enclose(const Leaf_faces& faces) {
  kernel::dop_limits(faces, K, low, high);
  widen(low, high, slabs);
}

template <int K>
double K_dop<K>::volume() const {
  std::array<Slab, K / 2> all;
  for (int i = 0; i < slabs; ++i)
    all[i] = {{1.0 * directions[i][0], 1.0 * directions[i][1], 1.0 * directions[i][2]}, low[i], high[i]};
  return polytope_volume(all, bounds());
}

template struct K_dop<14>;
template struct K_dop<18>;
template struct K_dop<26>;

}  // namespace lodestone
