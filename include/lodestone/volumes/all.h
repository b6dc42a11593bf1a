// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tuple>

#include "lodestone/volumes/aabb.h"
#include "lodestone/volumes/bounding_sphere.h"
#include "lodestone/volumes/bounding_volume.h"
#include "lodestone/volumes/k_dop.h"
#include "lodestone/volumes/oriented_box.h"
#include "lodestone/volumes/quospo.h"
#include "lodestone/volumes/spherical_shell.h"

namespace lodestone {

/// All models of Bounding_volume in the library. Tests and experiments iterate over this list.
using Bounding_volumes =
    std::tuple<Aabb, Bounding_sphere, Oriented_box, K_dop<14>, K_dop<18>, K_dop<26>, Quospo, Spherical_shell>;

}  // namespace lodestone
