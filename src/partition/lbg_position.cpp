// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/lbg_position.h"

namespace lodestone {

Labelling Lbg_position::label(const Numbered_surface& surface, std::size_t regions) const {
  Lbg_options positions_only = options;
  positions_only.features.normal_weight = 0;
  return Lbg{.options = positions_only}.label(surface, regions);
}

}  // namespace lodestone
