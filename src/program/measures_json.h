// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>

#include "lodestone/partition/partition_measures.h"

namespace lodestone {

/// All measures except the number of regions, by name.
inline nlohmann::ordered_json to_json(const Partition_measures& measures) {
  return {{"distortion", measures.distortion},
          {"size_balance", measures.size_balance},
          {"parts_per_region", measures.parts_per_region},
          {"border_length", measures.border_length},
          {"normal_deviation", measures.normal_deviation},
          {"geodesic_radius", measures.geodesic_radius},
          {"box_volume", measures.box_volume},
          {"ball_volume", measures.ball_volume}};
}

}  // namespace lodestone
