// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "lodestone/partition/partition.h"

namespace lodestone {

/// Quality of a partition, for comparing strategies. No figure depends on the units of the mesh.
struct Partition_measures {
  std::size_t regions = 0;  ///< number of regions
  double distortion = 0;    ///< sum |X - Q(X)|^2 / (k M) over position + normal of equal weight, k = 6, where Q(X) is
                            ///< the mean vector of the region of X
  double size_balance = 1;  ///< vertices of the largest region over the mean number of vertices; 1: all equal
  double parts_per_region = 1;  ///< connected parts before islands were repaired, over the regions left afterwards
  double border_length = 0;     ///< length of all borders over the square root of the surface's area
  double normal_deviation = 0;  ///< angle in degrees between the normal of a face and the mean normal of its region:
                                ///< root mean square over the surface. 90 where there is no mean, as of closed regions
  double geodesic_radius = 0;   ///< longest of the shortest paths along edges from a particle to a vertex of its
                                ///< region; mean over the regions, in radii of the object
  double box_volume = 0;   ///< of the boxes around the faces of each region, over that of the box around all; 0 for
                           ///< a surface that is flat along an axis
  double ball_volume = 0;  ///< the same of smallest enclosing balls
};

/// Measures a partition.
///
/// The radius of the object is the largest distance of a vertex from the mean of all vertices. Vertices that no face
/// uses do not count. A face belongs to regions as in `region_patches`. If the corners of a face are in two regions,
/// the border runs between the midpoints of two sides; if they are in three, it runs from the midpoints of all sides to
/// the centroid. O(V log V + F log F).
/// @throws Bad_argument  the labels or particles do not fit the surface, a region has no vertex with a face, or a
///                       particle is not at a vertex of its region that has a face
Partition_measures measure_partition(const Numbered_surface& surface, const Numbered_partition& partition);

/// The same for a mesh with its region map.
/// @param np  `vertex_point_map`
/// @throws Bad_mesh  see Mesh_numbering and read_positions
template <Triangle_mesh Mesh, Region_map<Mesh> Regions,
          class Named_parameters = CGAL::parameters::Default_named_parameters>
Partition_measures measure_partition(const Mesh& mesh, const Partition<Mesh>& partition, const Regions& region_map,
                                     const Named_parameters& np = CGAL::parameters::default_values()) {
  const Mesh_numbering<Mesh> numbering(mesh);
  const Vertex_graph graph = vertex_graph(numbering.vertex_count(), numbering.corners());
  const Positions positions = read_positions(numbering, vertex_points(mesh, np));
  Numbered_partition numbered{
      .labels = {}, .regions = partition.regions, .particles = {}, .statistics = partition.statistics};
  for (std::uint32_t v = 0; v < numbering.vertex_count(); ++v)
    numbered.labels.push_back(get(region_map, numbering.vertex(v)));
  for (const auto v : partition.particles) numbered.particles.push_back(numbering.index(v));
  return measure_partition({graph, positions, numbering.corners()}, numbered);
}

}  // namespace lodestone
