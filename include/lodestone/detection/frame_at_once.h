// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <utility>

#include "lodestone/detection/detector_options.h"
#include "lodestone/detection/frame.h"
#include "lodestone/mesh/check_finite.h"
#include "lodestone/mesh/coordinate_reader.h"
#include "lodestone/mesh/faces_in_box.h"
#include "lodestone/mesh/joined_vertices.h"
#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/mesh/own_points.h"
#include "lodestone/mesh/stopwatch.h"

/// Frames of the mode `exact` for meshes that are asked about once: nothing is built that another frame would need.
namespace lodestone {

/// Whether a frame of two meshes can be made at once. Not with another mode, a tolerance, containment, parting or
/// patches, nor where the number of contacts is limited: which of them are listed depends on the trees.
/// @throws Bad_argument  an option out of range
bool can_answer_at_once(const Detector_options& options);

/// Two surfaces, as far as they can meet.
struct Overlapping_surfaces {
  Box box_a;       ///< around all vertices of the first
  Box box_b;       ///< around all vertices of the second
  Faces_in_box a;  ///< faces of the first that meet the overlap of both boxes
  Faces_in_box b;  ///< and of the second
};
/// Makes the frame of two surfaces, the objects 0 and 1.
/// @param reading  seconds that it took to read them
/// @param frame    default-constructed; is filled
void make_overlap_frame(const Overlapping_surfaces& surfaces, const Detector_options& options, double reading,
                        Frame& frame);
/// The frame of one surface, the object 0, and itself.
/// @param corners  without doubled vertices
Frame self_frame(std::span<const Corners> corners, Coordinates coordinates, const Detector_options& options);

/// The first frame of a Detector to which two meshes have been added, without that detector. It has the same contacts,
/// points and normals; with the query `first`, the contact may be another one. Times are `broad_phase` and
/// `confirmation`.
///
/// O(V) for two meshes whose boxes are apart and which have no border: then the numbers of edges and faces alone tell
/// that all faces are triangles, unless faces of two edges, which some of CGAL's operations make, stand beside larger
/// ones. Else O(V + F), and what an Overlap_search takes for the faces where the boxes overlap; if it gives up, what
/// trees of these faces take, which are thrown away.
///
/// @param points_a, points_b  vertex point maps: where the vertices are
/// @return none: the detector has to answer. So it is if `can_answer_at_once` is false, if a and b are the same mesh,
///         and for meshes that a detector refuses, with the reason
/// @throws Bad_argument  an option out of range
template <Triangle_mesh Mesh_a, Vertex_point_map<Mesh_a> Points_a, Triangle_mesh Mesh_b,
          Vertex_point_map<Mesh_b> Points_b>
std::optional<Frame> frame_at_once(const Mesh_a& a, Points_a points_a, const Mesh_b& b, Points_b points_b,
                                   const Detector_options& options) {
  std::optional<Frame> frame;  // in its place: a move would run as much cold code as making it
  if (!can_answer_at_once(options) || static_cast<const void*>(&a) == static_cast<const void*>(&b)) return frame;
  Overlapping_surfaces surfaces;
  bool usable = false;
  double reading = 0;
  timed(reading, [&] {
    Box_reader<Mesh_a, Points_a> reader_a(a, std::move(points_a));
    Box_reader<Mesh_b, Points_b> reader_b(b, std::move(points_b));
    if (!reader_a.read_positions() || !reader_b.read_positions()) return;
    surfaces.box_a = reader_a.box(), surfaces.box_b = reader_b.box();
    const Box overlap = surfaces.box_a.intersection(surfaces.box_b);
    usable = reader_a.read_faces(overlap, surfaces.a) && reader_b.read_faces(overlap, surfaces.b);
  });
  if (!usable) return frame;
  make_overlap_frame(surfaces, options, reading, frame.emplace());
  frame->statistics.vertices_read = num_vertices(a) + num_vertices(b);
  return frame;
}

/// The same where the vertices are at the meshes' own points.
template <Triangle_mesh Mesh_a, Triangle_mesh Mesh_b>
std::optional<Frame> frame_at_once(const Mesh_a& a, const Mesh_b& b, const Detector_options& options) {
  return frame_at_once(a, Own_points<Mesh_a>(CGAL::get_const_property_map(CGAL::vertex_point, a)), b,
                       Own_points<Mesh_b>(CGAL::get_const_property_map(CGAL::vertex_point, b)), options);
}

/// The first frame of a Detector to which one mesh has been added, with `Exact_options::self_collision`: without
/// regions, and with a tree that is thrown away. It has the same contacts, points, normals and patches; where the
/// number of contacts is limited and regions are asked for, others may be listed.
///
/// O(F log F).
///
/// @param points         a vertex point map: where the vertices are
/// @param file_vertex    see `Object_options::file_vertex`
/// @throws Bad_mesh      no face, a face that is no triangle, a coordinate that is not finite
/// @throws Bad_argument  an option out of range, another mode than `exact` or `certified`; `file_vertex` does not have
///                       one entry per vertex
template <Triangle_mesh Mesh, Vertex_point_map<Mesh> Points>
Frame self_frame_at_once(const Mesh& mesh, Points points, Detector_options options,
                         std::span<const std::uint32_t> file_vertex = {}) {
  options.exact.self_collision = true;
  check(options);
  double reading = 0;
  std::optional<Mesh_numbering<Mesh>> numbering;
  std::vector<Corners> joined;
  Coordinate_reader<Mesh, Points> reader(std::move(points));
  Coordinates positions;
  timed(reading, [&] {
    numbering.emplace(mesh);
    joined = join_vertices(numbering->corners(), numbering->vertex_count(), file_vertex);
    positions = reader.read(*numbering);
    check_finite(positions, title_of(0, {}));
  });
  Frame frame = self_frame(joined.empty() ? std::span(numbering->corners()) : joined, positions, options);
  frame.statistics.seconds.build += reading;
  return frame;
}

/// The same where the vertices are at the mesh's own points.
template <Triangle_mesh Mesh>
Frame self_frame_at_once(const Mesh& mesh, const Detector_options& options,
                         std::span<const std::uint32_t> file_vertex = {}) {
  return self_frame_at_once(mesh, Own_points<Mesh>(CGAL::get_const_property_map(CGAL::vertex_point, mesh)), options,
                            file_vertex);
}

}  // namespace lodestone
