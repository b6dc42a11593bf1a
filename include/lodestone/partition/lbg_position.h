// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lodestone/partition/lbg.h"

namespace lodestone {

/// Partition strategy: the cells of LBG quantisation over the position of each vertex alone. See `Lbg`.
struct Lbg_position {
  static constexpr std::string_view name = "lbg_position";  ///< for `make_strategy`, tables and messages
  static constexpr bool is_concurrent = true;               ///< see Partition_strategy

  Lbg_options options = {};  ///< the weight of the normals is ignored

  /// See Partition_strategy.
  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  /// The same for a surface by index.
  /// @throws Bad_argument  as `quantise`
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

}  // namespace lodestone
