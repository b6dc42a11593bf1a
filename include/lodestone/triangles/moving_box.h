// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/mesh/box.h"

namespace lodestone {

/// A box whose two corners move on straight lines while t goes from 0 to 1. If points move on straight lines from
/// inside `start` to inside `end`, they are inside it all the time.
struct Moving_box {
  Box start;  ///< at t = 0; not empty
  Box end;    ///< at t = 1; not empty
};

/// Lower bound on the first t in [0, 1] at which two moving boxes overlap; infinity only if they never do.
///
/// A bound is 0 only if the boxes overlap at the start, or if they do before 10^-290. It falls short of the first t by
/// a relative error of at most 2^-49 where one axis alone decides. Some forty floating-point operations, fewer if the
/// boxes are apart along one axis all the time.
double overlap_time_lower_bound(const Moving_box& a, const Moving_box& b);

}  // namespace lodestone
