// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detector.h"

namespace lodestone {

template class Detector<Surface_mesh, Any_strategy>;

}  // namespace lodestone
