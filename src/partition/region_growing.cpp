// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/region_growing.h"

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing_on_polygon_mesh.h>

#include <algorithm>
#include <iterator>

#include "lodestone/partition/face_labels.h"
#include "lodestone/partition/oriented_mesh.h"
#include "lodestone/partition/region_count.h"
#include "partition/face_geometry.h"
#include "partition/refusals.h"
#include "partition/used_surface.h"

namespace lodestone {

namespace {

void check(const Region_growing_options& options) {
  if (!(options.angle >= 0 && options.angle <= 90))
    throw Bad_argument("region growing: the angle must be between 0 and 90 degrees");
  if (!(options.distance >= 0 && options.distance <= 1))
    throw Bad_argument("region growing: the distance must be between 0 and 1");
}

double longest_side(const Surface_mesh& mesh) {
  const auto box = CGAL::Polygon_mesh_processing::bbox(mesh);
  return std::max({box.x_span(), box.y_span(), box.z_span()});
}

/// The faces of each area, by their index in the mesh.
std::vector<std::vector<std::size_t>> grow(const Surface_mesh& mesh, const Region_growing_options& options) {
  using Neighbours = CGAL::Shape_detection::Polygon_mesh::One_ring_neighbor_query<Surface_mesh>;
  using Plane = CGAL::Shape_detection::Polygon_mesh::Least_squares_plane_fit_region<Kernel, Surface_mesh>;
  const auto all = faces(mesh);
  Neighbours neighbours_of(mesh);
  Plane plane(mesh, options.distance * longest_side(mesh), options.angle, 1, mesh.points());
  CGAL::Shape_detection::Region_growing<decltype(all), Neighbours, Plane> growing(all, neighbours_of, plane);
  std::vector<std::vector<std::size_t>> areas;
  growing.detect(std::back_inserter(areas));
  return areas;
}

}  // namespace

std::vector<Region_index> flat_areas(const Numbered_surface& surface, const Region_growing_options& options) {
  check(options);
  std::vector<Region_index> result(surface.faces.size(), no_region);
  const Oriented_mesh oriented = oriented_mesh(surface);
  if (oriented.face_indices.empty()) return result;
  const auto areas = with_refusals_as_bad_mesh(Region_growing::name, [&] { return grow(oriented.mesh, options); });
  const auto geometry = face_geometry(surface);
  for (Region_index area = 0; area < areas.size(); ++area)
    for (const auto f : areas[area])
      if (geometry.areas[oriented.face_indices[f]] > 0) result[oriented.face_indices[f]] = area;
  return result;
}

Labelling Region_growing::label(const Numbered_surface& surface, std::size_t regions) const {
  return label_used(surface, regions, [this](const Numbered_surface& used, std::size_t wanted) -> Labelling {
    Labelling result{.labels = vertex_labels(used, flat_areas(used, options))};
    adjust_region_count(used.graph, used.positions, result.labels, wanted);
    return result;
  });
}

}  // namespace lodestone
