// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "lodestone/partition/partition.h"

namespace lodestone {

struct Vsa_options {
  std::size_t relaxations = 2;         ///< after each proxy or doubling of them; [1, 100]
  std::size_t single_insertions = 64;  ///< so many proxies come one by one, the rest by doubling; <= 1e6
  double tolerance = 0.01;             ///< relative change of the error at which relaxation ends; (0, 1)
  std::size_t max_iterations = 30;     ///< of the relaxation at the end; <= 1e6
};

/// Partition strategy: areas that a plane each approximates well.
///
/// Variational shape approximation of Cohen-Steiner, Alliez and Desbrun, "Variational shape approximation", 2004, by
/// CGAL: the faces around N proxies (normals), each face with the one whose normal is nearest (metric L2,1), areas
/// connected. A new proxy starts at the worst face of the worst area; beyond `single_insertions` their number doubles,
/// where the error is. Vertices take the label of most of the area around them, see `vertex_labels`.
///
/// Normals and areas of faces are Lodestone's own: a face whose area is no more than rounding has neither. As areas of
/// fewer than four faces describe no shape, there are no more than F / 4 proxies; `adjust_region_count` makes up for
/// the rest, and for labels that no vertex could keep. Nothing is drawn at random.
/// O(N (F log F)) up to `single_insertions`: 200 000 faces and 64 regions take about 20 s.
struct Vsa {
  static constexpr std::string_view name = "vsa";

  Vsa_options options = {};

  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  /// @throws Bad_argument  no region wanted, or an option out of range
  Labelling label(const Numbered_surface& surface, std::size_t regions) const;
};

}  // namespace lodestone
