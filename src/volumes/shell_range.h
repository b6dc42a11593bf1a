// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/volumes/spherical_shell.h"

namespace lodestone {

/// A range that contains the exact squared distances of the points of a shell from some point.
struct Squared_range {
  double low;
  double high;
};

/// The tighter of the two bounds that the documentation of `near` derives.
/// @param shell, from  `shell` has a shell, or `from` is the centre of one
Squared_range squared_distances(const Spherical_shell& shell, const double* from);

}  // namespace lodestone
