// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "lodestone/mesh/live_positions.h"
#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/mesh/vertex_graph.h"
#include "lodestone/mesh/workers.h"

/// How large the regions of a surface have become: what triggers repartitioning.
namespace lodestone {

/// Path along mesh edges from a region's home vertex to its border, or as far as the region goes, in one direction of
/// the tangent plane.
struct Border_path {
  double length = 0;  ///< in the units of the positions; 0: the home vertex lies on the border on that side
  /// The home vertex, at most three vertices in between, and the border vertex; empty for length 0. They tell how the
  /// path stretches, without a pass over all its vertices.
  std::vector<std::uint32_t> samples = {};
  double sampled_length = 0;  ///< of the polyline through the samples when the path was found
};

/// Distances from a region's home vertex, where its particle started, to its border in the directions +X, -X, +Y, -Y of
/// the tangent plane there.
struct Region_extent {
  std::array<Border_path, 4> paths;  ///< +X, -X, +Y, -Y

  /// Area of the rectangle (d+X + d-X)(d+Y + d-Y) of \cite saenghaengtham2006.
  double area() const { return (paths[0].length + paths[1].length) * (paths[2].length + paths[3].length); }
};

/// What the extents of a region are measured on.
struct Extent_input {
  const Vertex_graph& graph;             ///< of the surface that is walked along
  std::span<const Region_index> labels;  ///< V
  const std::vector<bool>& open_border;  ///< V, see `open_border`
  const Live_positions& position;        ///< in the current frame
};

/// Where the extent of a region is measured from.
struct Extent_start {
  std::uint32_t home = 0;  ///< a vertex of the region
  /// Of the tangent plane, of any length; zero: the plane z = 0.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  /// Its projection into the plane becomes X; zero: the coordinate axis nearest to the plane.
  Eigen::Vector3d x_axis = Eigen::Vector3d::Zero();
};

/// Measures a region from each start. First finds the shortest paths from its home along the edges within the region
/// (Dijkstra). Then takes, in each direction, the nearest border vertex within a cone. There are four cones, of 5.6,
/// 11, 22 and 45 degrees to either side; the narrowest that holds a border vertex counts.
///
/// The border consists of the vertices with a neighbour in another region and of those on an open border of the mesh. A
/// region that runs round a tube goes on in a direction without a border. It is measured to the farthest vertex in the
/// narrowest cone that holds any vertex, if that cone holds no border vertex, and the farthest vertex is more than 1.5
/// times as far as the border found in wider cones. A region without a border is a whole closed component, and measured
/// to its farthest vertex within 45 degrees. O(V) for the working memory, and O(n log n) for each region of n vertices,
/// which the workers share; each worker has memory of its own. Reads positions of these regions only.
std::vector<Region_extent> region_extents(const Extent_input& input, std::span<const Extent_start> starts,
                                          Workers& workers = Workers::alone());

/// Angle by which a vector must turn around the normal to point along the X that `region_extents` chooses for a zero
/// `x_axis`.
/// @param needle  any vector that is not parallel to the normal
/// @return radians; 0 if the angle is undefined
double angle_to_axis(const Eigen::Vector3d& normal, const Eigen::Vector3d& needle);

/// Estimated current area of the region: each path is assumed to have stretched as much as the polyline through its
/// samples. At most 20 reads, whatever the size of the region.
template <class Reader>
double stretched_area(const Region_extent& extent, const Reader& reader) {
  std::array<double, 4> lengths{};
  for (std::size_t direction = 0; direction < 4; ++direction) {
    const Border_path& path = extent.paths[direction];
    if (path.samples.empty() || path.sampled_length == 0) continue;
    double now = 0;
    Eigen::Vector3d previous = reader(path.samples.front());
    for (std::size_t i = 1; i < path.samples.size(); ++i) {
      const Eigen::Vector3d next = reader(path.samples[i]);
      now += (next - previous).norm();
      previous = next;
    }
    lengths[direction] = path.length * (now / path.sampled_length);
  }
  return (lengths[0] + lengths[1]) * (lengths[2] + lengths[3]);
}

}  // namespace lodestone
