// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tuple>

#include "lodestone/contact/bounding_volume.h"
#include "lodestone/contact/volumes/aabb.h"

namespace lodestone {

/// All models of Bounding_volume that the library has: what its tests and experiments run through.
using Bounding_volumes = std::tuple<Aabb>;

}  // namespace lodestone
