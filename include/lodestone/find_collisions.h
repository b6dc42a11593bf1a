// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "lodestone/detection/frame_at_once.h"
#include "lodestone/detector.h"

namespace lodestone {

/// What `find_collisions` found; of `find_self_collisions`, a and b are the same mesh.
struct Collisions {
  bool collides = false;         ///< the surfaces intersect
  bool near = false;             ///< faces are nearer than the tolerance, or intersect; false without one
  std::vector<Face_pair> faces;  ///< faces of a and b that intersect, or are nearer than the tolerance; sorted
  std::vector<std::uint8_t> intersects = {};    ///< parallel to `faces`, without a tolerance empty: 1 where the faces
                                                ///< intersect, 0 where they are near but apart
  std::vector<Intersection_points> points;      ///< parallel to `faces`: where they meet; empty unless asked for
  std::vector<Contact_normal> normals;          ///< parallel to `faces`; empty unless asked for
  bool capped = false;                          ///< there are more face pairs than `Detector_options::most_contacts`
  Containment containment = Containment::none;  ///< which mesh lies inside the other; none unless asked for
  std::optional<Parting> parting = {};          ///< moves a; none unless asked for and needed
  std::vector<Contact_patch> patches = {};      ///< of `faces`; empty unless asked for
  bool unfinished = false;                      ///< see `Pair_result::unfinished`
  Frame_statistics statistics = {};             ///< what it took
};

/// @cond  helpers
/// What a frame says about its only pair.
Collisions collisions_of(Frame&& frame);
/// @endcond

/// Finds collisions between two meshes, which may be of different types, with one call.
///
/// Whatever is reported is true, by exact predicates. Mode `exact`, the default, misses nothing; mode `particles` may
/// miss a collision. Faces are numbered in the order of `faces(mesh)`. Only what is between the two counts:
/// `self_collision` changes nothing.
///
/// Nothing is built where `frame_at_once` answers. A tolerance, containment, parting, patches, a limit on the number of
/// contacts and other modes need a Detector, which this call makes and throws away. To follow meshes that move, keep a
/// Detector. The query `first` gives one contact, which need not be the one that a Detector gives.
///
/// Cost O(V + F) to read both and to find the faces in the overlap of their boxes, and O(n log n) for n such faces;
/// with a Detector O(F log F).
///
/// @param np_a, np_b  `vertex_point_map`: where the vertices are; default: the meshes' own points. With one for
///                    either, a and b may be the same mesh
/// @return contacts as `options.contacts` asks: none, one, or all, up to `most_contacts`
/// @throws Bad_mesh      no face, a face that is no triangle, a coordinate that is not finite, removed elements. Where
///                       the boxes around two meshes are apart, faces of two edges may go unnoticed beside larger ones:
///                       see `frame_at_once`
/// @throws Bad_argument  an option out of range, one that the mode does not take, or one mesh given twice without such
///                       a map
template <Triangle_mesh Mesh_a, Triangle_mesh Mesh_b, class Parameters_a = CGAL::parameters::Default_named_parameters,
          class Parameters_b = CGAL::parameters::Default_named_parameters>
Collisions find_collisions(const Mesh_a& a, const Mesh_b& b, const Detector_options& options = {},
                           const Parameters_a& np_a = CGAL::parameters::default_values(),
                           const Parameters_b& np_b = CGAL::parameters::default_values()) {
  need_same_containers();
  if (auto frame = frame_at_once(a, vertex_points(a, np_a), b, vertex_points(b, np_b), options))
    return collisions_of(std::move(*frame));
  using CGAL::internal_np::vertex_point_t, CGAL::parameters::is_default_parameter;
  constexpr bool own_points = is_default_parameter<Parameters_a, vertex_point_t>::value &&
                              is_default_parameter<Parameters_b, vertex_point_t>::value;
  Detector detector(options);
  const auto add = [&](const auto& mesh, const auto& np, const char* name) {
    if constexpr (own_points)
      return detector.add(mesh, {.name = name});
    else
      return detector.add(mesh, vertex_points(mesh, np), {.name = name});
  };
  const Object_id first = add(a, np_a, "the first mesh"), second = add(b, np_b, "the second mesh");
  return collisions_of(Frame(finds_all(options.mode) ? detector.detect(first, second) : detector.detect()));
}

/// Finds the faces of one mesh that intersect each other, with one call. `Collisions::faces` are face pairs a < b.
/// Which faces count, and what options mean, is as in a Detector with `Exact_options::self_collision`, which this
/// call sets. It gives the same contacts and keeps nothing: see `self_frame_at_once`.
///
/// Nothing moves between two frames, so a `self_tolerance` finds no more than faces that intersect. A `tolerance` is
/// between two objects, and changes nothing. Modes `exact` and `certified` do the same.
///
/// Cost O(F log F) for the tree, which is thrown away.
///
/// @param file_vertex    which vertices are one: see `Object_options::file_vertex`
/// @param np             `vertex_point_map`: where the vertices are; default: the mesh's own points
/// @return contacts as `options.contacts` asks: none, one, or all, up to `most_contacts`
/// @throws Bad_mesh      no face, a face that is no triangle, a coordinate that is not finite, a Surface_mesh with
///                       removed elements
/// @throws Bad_argument  an option out of range, another mode; `file_vertex` does not have one entry per vertex
template <Triangle_mesh Mesh, class Parameters = CGAL::parameters::Default_named_parameters>
Collisions find_self_collisions(const Mesh& mesh, const Detector_options& options = {},
                                std::span<const std::uint32_t> file_vertex = {},
                                const Parameters& np = CGAL::parameters::default_values()) {
  need_same_containers();
  return collisions_of(self_frame_at_once(mesh, vertex_points(mesh, np), options, file_vertex));
}

extern template std::optional<Frame> frame_at_once(const Surface_mesh&, Own_points<Surface_mesh>, const Surface_mesh&,
                                                   Own_points<Surface_mesh>, const Detector_options&);
extern template Frame self_frame_at_once(const Surface_mesh&, Own_points<Surface_mesh>, Detector_options,
                                         std::span<const std::uint32_t>);
extern template std::optional<Frame> frame_at_once(const Indexed_mesh&, Own_points<Indexed_mesh>, const Indexed_mesh&,
                                                   Own_points<Indexed_mesh>, const Detector_options&);
extern template Frame self_frame_at_once(const Indexed_mesh&, Own_points<Indexed_mesh>, Detector_options,
                                         std::span<const std::uint32_t>);

}  // namespace lodestone
