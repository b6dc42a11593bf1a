// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter/face_filter_kernel.h"
#include "lodestone/volumes/aabb.h"

namespace lodestone {

/// How the faces within two boxes are rounded. Rounding and steps are finest where the two boxes overlap: only faces
/// there may meet. Where the boxes only touch, the overlap is flat, and steps of its size would separate nothing: each
/// of its sides counts as at least a thousandth of the smaller box.
kernel::Filter_request filter_request(const Aabb& a, const Aabb& b, double margin);

/// Whether one of two leaves' boxes is so small against the region of a request that its faces would share few steps.
bool is_too_coarse(const kernel::Filter_request& request, const Aabb& a, const Aabb& b);

}  // namespace lodestone
