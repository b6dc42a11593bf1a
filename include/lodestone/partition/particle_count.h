// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/mesh/vertex_graph.h"

/// How many particles an object needs: as many as other objects can touch it at once.
namespace lodestone {

/// A sphere around a part of a surface.
struct Sphere {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< in units of the coordinates
  double radius = 0;                                 ///< in the same units
  double roundness = 1;  ///< distance of the nearest vertex from the centre, in radii; 1: all are on the sphere
};

/// Options of the rule that says how many particles an object gets.
struct Particle_count_options {
  double crease_degrees = 40;        ///< a vertex whose normal differs by more from a neighbour's is critical; (0, 180]
  double smallest_part = 0.02;       ///< parts with a smaller share of the vertices with edges are ignored; [0, 1]
  std::size_t most_parts = 8;        ///< spheres per object at most; >= 1
  double equal_sizes = 0.05;         ///< radii that differ by no more than this share count as equal; >= 0
  double least_roundness = 0.7;      ///< least roundness at which an object counts as a sphere; [0, 1]
  std::size_t most_particles = 256;  ///< upper limit per object; >= 1
};

/// @throws Bad_argument  an option out of range
void check(const Particle_count_options& options);

/// Particles for objects of equal size: the kissing number of spheres, 12, or the number of objects if that is lower.
std::size_t kissing_particle_count(std::size_t objects);

/// Particles for a sphere of radius R beside objects no smaller than a sphere of radius r. The small sphere casts a
/// shadow on the large one, seen from the centre of the large one. The count is how often the area of that shadow fits
/// into the area of the large sphere.
///
/// The shadow is a spherical cap of half-angle theta = asin(r / (R + r)). On a sphere of area A = 4 pi it has the area
/// B = 2 pi (1 - cos theta). The count is floor(A / B), at least 1 \cite saenghaengtham2006. Equal spheres give 14, an
/// upper bound on the kissing number 12.
///
/// @param radius    R, > 0
/// @param smallest  r, > 0, in the same unit
/// @throws Bad_argument  a radius that is not finite or not > 0
std::size_t shadow_particle_count(double radius, double smallest);

/// Smallest sphere around the positions, in their unit, by CGAL's Min_sphere_of_spheres_d. Its radius is 0 for no
/// position and for equal ones, and where their extent exceeds the largest double. O(V) expected.
Sphere bounding_sphere(const Positions& positions);

/// Smallest sphere around a surface: around the positions that faces use; around all if there is no face.
Sphere bounding_sphere(const Positions& positions, std::span<const Corners> faces);

/// Approximates a surface by a few spheres, one per part.
///
/// A vertex is critical if its normal differs by more than `crease_degrees` from that of a neighbour. Critical vertices
/// split the surface into parts. Each part that is large enough gets the bounding sphere of its vertices. If no vertex
/// is critical, or no part is large enough, each connected component is a part. If none of these is large enough, the
/// whole surface gets one sphere, as `bounding_sphere` of positions and faces. Cost O(V + E) expected.
///
/// @return at least one sphere, in the order of the lowest vertices of the parts
std::vector<Sphere> sphere_collection(const Vertex_graph& graph, const Positions& positions,
                                      std::span<const Corners> faces, const Particle_count_options& options = {});

/// The same for a mesh.
/// @param np  `vertex_point_map`
/// @throws Bad_mesh  see Mesh_numbering and read_positions
template <Triangle_mesh Mesh, class Named_parameters = CGAL::parameters::Default_named_parameters>
std::vector<Sphere> sphere_collection(const Mesh& mesh, const Particle_count_options& options = {},
                                      const Named_parameters& np = CGAL::parameters::default_values()) {
  const Mesh_numbering<Mesh> numbering(mesh);
  return sphere_collection(vertex_graph(numbering.vertex_count(), numbering.corners()),
                           read_positions(numbering, vertex_points(mesh, np)), numbering.corners(), options);
}

/// The bounding radii of the objects of a scene, as far as the particle count depends on them.
struct Radius_range {
  double smallest = 0;    ///< in units of the coordinates
  double largest = 0;     ///< the same
  std::size_t count = 0;  ///< objects
};

/// @param radii  one per object, not empty
Radius_range radius_range(std::span<const double> radii);

/// Particles for one object of a scene: `kissing_particle_count` for a sphere among objects of its own size; for any
/// other object the sum of `shadow_particle_count` over its spheres, against the smallest object of the scene. A
/// detector leaves out objects without extent when it looks for that.
///
/// @param object   spheres of the object
/// @param radii    of all objects of the scene
/// @return at least 1, at most `most_particles`
std::size_t particle_count(std::span<const Sphere> object, const Radius_range& radii,
                           const Particle_count_options& options = {});

}  // namespace lodestone
