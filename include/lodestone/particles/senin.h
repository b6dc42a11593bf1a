// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lodestone/mesh/patch.h"
#include "lodestone/mesh/vertex_faces.h"
#include "lodestone/mesh/vertex_graph.h"

/// The predecessor, after Senin et al. 2003 as \cite saenghaengtham2006 describes it: particles are scattered over the
/// whole surface, repel those of the same object and attract those of other objects. Nothing is partitioned.
///
/// Forces and movement are those of `relax()` with `siblings_repel` and every vertex in one region. What the
/// description leaves open is settled such that the two methods differ in nothing else. So if two particles are nearer
/// than the collision distance, the faces around both are tested, as many as a region would hold.
namespace lodestone {

/// Options of the mode `senin`.
struct Senin_options {
  std::uint64_t seed = 1;                    ///< of the scattering
  std::optional<Eigen::Vector3d> side = {};  ///< scatter only where the surface lies farthest in this direction
  std::size_t rings = 0;                     ///< hops around a particle that are tested; 0: see `default_rings`
};

/// @throws Bad_argument  `side` is zero or not finite
void check(const Senin_options& options);

/// Vertices at which N particles start: different vertices drawn at random, among those with edges. With `side`, only
/// those are drawn whose offset from the mean of all with edges along `side` is at least half of the largest.
/// @return N vertices, or all if there are fewer to draw from
/// @throws Bad_argument  `side` is zero or not finite
std::vector<std::uint32_t> scatter_particles(const Vertex_graph& graph, const Positions& positions,
                                             std::size_t particles, const Senin_options& options);

/// Hops around a particle within which about V / N vertices lie: 3 r (r + 1) + 1 of them on a surface of degree 6.
std::size_t default_rings(std::size_t vertices, std::size_t particles);

/// The faces with a corner at most `rings` hops from `centre`. The cost depends on the number of faces found, not on V.
Patch ring_patch(const Vertex_graph& graph, const Vertex_faces& vertex_faces, std::span<const Corners> corners,
                 std::uint32_t centre, std::size_t rings);

}  // namespace lodestone
