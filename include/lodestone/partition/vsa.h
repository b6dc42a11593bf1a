// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// Options of Vsa.
struct Vsa_options {
  std::size_t relaxations = 2;         ///< after each inserted proxy, and after each doubling; [1, 100]
  std::size_t single_insertions = 64;  ///< proxies inserted one by one, before their number doubles; <= 1e6
  double tolerance = 0.01;             ///< relative change of the error at which relaxation ends; (0, 1)
  std::size_t max_iterations = 30;     ///< of the final relaxation; <= 1e6
};

/// Partition strategy: areas that are each well approximated by a plane.
///
/// Cohen-Steiner, Alliez and Desbrun, "Variational shape approximation", 2004, by CGAL. There are N proxies, which are
/// normals, and each gathers a connected area: every face goes to the proxy with the nearest normal (metric L2,1). A
/// new proxy starts at the worst face of the worst area. Beyond `single_insertions` the number of proxies doubles
/// instead, where the error is. Vertices take the label with the largest area around them, see `vertex_labels`.
///
/// Normals and areas of faces are Lodestone's own: a face whose area is no more than rounding has neither. Areas of
/// fewer than four faces describe no shape, so no more than about F / 4 proxies. Where the error is no more than
/// rounding, as on a flat surface, a further proxy would be as good anywhere, so none is added. `adjust_region_count`
/// makes the missing regions, also for labels that no vertex could keep. Nothing is random. O(N (F log F)) up to
/// `single_insertions`: 200 000 faces and 64 regions take about 20 s.
struct Vsa {
  static constexpr std::string_view name = "vsa";  ///< for `make_strategy`, tables and messages
  static constexpr bool is_concurrent = true;      ///< see Partition_strategy

  Vsa_options options = {};  ///< of the approximation

  /// See Partition_strategy.
  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  /// The same for a surface by index.
  /// @throws Bad_argument  no region wanted, or an option out of range
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

}  // namespace lodestone
