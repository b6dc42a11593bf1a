// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/volumes/spherical_shell.h"

namespace lodestone {

/// Squared distances of the points of a shell from some point are in this range, whatever the rounding.
struct Squared_range {
  double low;
  double high;
};

/// The two bounds that the documentation of `near` derives.
/// @param shell, from  one of them is a shell that is one, or its centre
Squared_range squared_distances(const Spherical_shell& shell, const double* from);

}  // namespace lodestone
