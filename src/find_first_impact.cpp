// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/find_first_impact.h"

#include "lodestone/mesh/arithmetic.h"
#include "lodestone/mesh/check_finite.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {

void check_different(const void* a, const void* b) {
  if (a == b) throw Bad_argument("one mesh is given twice; find_first_self_impact finds what it does to itself");
}

std::optional<Impact> checked_first_impact(const Moving_surface& a, const Moving_surface& b) {
  check_arithmetic();
  check_finite(a.start, "the first mesh, at the start,");
  check_finite(a.end, "the first mesh, at the end,");
  check_finite(b.start, "the second mesh, at the start,");
  check_finite(b.end, "the second mesh, at the end,");
  return first_impact(a, b);
}

std::optional<Impact> checked_first_self_impact(const Moving_surface& surface) {
  check_arithmetic();
  check_finite(surface.start, "the mesh, at the start,");
  check_finite(surface.end, "the mesh, at the end,");
  return first_self_impact(surface);
}

}  // namespace lodestone
