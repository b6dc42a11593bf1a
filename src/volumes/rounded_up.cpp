// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/rounded_up.h"

#include <algorithm>
#include <cmath>

#include "volumes/scale.h"

namespace lodestone {
namespace {

double distance_above_scaled(const double* p, const double* q) {
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(p[axis] - q[axis]));
  if (largest == 0) return 0;
  const Scale scale(largest);
  const double x = scale.difference(p[0], q[0]), y = scale.difference(p[1], q[1]), z = scale.difference(p[2], q[2]);
  return scale.length_above(above(std::sqrt(x * x + y * y + z * z)));
}

}  // namespace

double distance_above(const double* p, const double* q) {
  const double x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
  const double squared = x * x + y * y + z * z;
  return is_ordinary(squared) ? above(std::sqrt(squared)) : distance_above_scaled(p, q);
}

}  // namespace lodestone
