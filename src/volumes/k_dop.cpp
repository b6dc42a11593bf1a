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

/// Widens the limits of rounded sums so that the exact sums are between them.
///
/// Let R be the sum of the largest |x|, |y| and |z|, and u = 2^-53. The error of a sum of two numbers is at most u of
/// its size. So the error of a sum of three, whose parts are at most R (1 + u), is at most 2 u (1 + u) R. The
/// subtraction of the slack adds at most u (1 + 8 u) R. R itself is computed to 2 u. A slack of 8 u R is far more than
/// these 3.1 u R. Sums below 2^-1021 do not round. For larger ones the slack is at least 2^-1072, with a relative error
/// of at most 1/8.
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
