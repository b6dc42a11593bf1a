// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lodestone/detector.h"

namespace lodestone {

/// What `find_collisions` found.
struct Collisions {
  bool collide = false;          ///< the surfaces intersect
  bool near = false;             ///< faces are nearer than the tolerance, or intersect; false without one
  std::vector<Face_pair> faces;  ///< faces of a and b that intersect, or are nearer than the tolerance; sorted
  std::vector<Intersection_points> points;  ///< parallel to `faces`: where they meet; empty unless asked for
  std::vector<Contact_normal> normals;      ///< parallel to `faces`; empty unless asked for
  bool capped = false;                      ///< there are more face pairs than `Detector_options::most_contacts`
  Containment containment = Containment::none;
  std::optional<Parting> parting = {};      ///< moves a; none unless asked for and needed
  std::vector<Contact_patch> patches = {};  ///< of `faces`; empty unless asked for
  Frame_statistics statistics = {};
};

/// Finds collisions between two meshes, which may be of different types, with one call.
///
/// Whatever is reported is true, by exact predicates. Mode `exact`, the default, misses nothing; mode `particles` may
/// miss a collision. Faces are numbered in the order of `faces(mesh)`. To follow meshes that move, keep a
/// `Detector`: most of the time goes into the partition, which it makes once. Only what is between the two counts:
/// `self_collision` changes nothing.
///
/// @throws Bad_mesh      no face, a face that is no triangle, a coordinate that is not finite
/// @throws Bad_argument  an option out of range, or one mesh given twice
template <Triangle_mesh Mesh_a, Triangle_mesh Mesh_b>
Collisions find_collisions(const Mesh_a& a, const Mesh_b& b, const Detector_options& options = {}) {
  Detector detector(options);
  const Object_id first = detector.add(a), second = detector.add(b);
  const Frame& frame = options.mode == Mode::exact ? detector.detect(first, second) : detector.detect();
  return {.collide = frame.collides(),
          .near = frame.near(),
          .faces = frame.face_pairs,
          .points = frame.contact_points,
          .normals = frame.contact_normals,
          .capped = frame.capped(),
          .containment = frame.pairs.empty() ? Containment::none : frame.pairs.front().containment,
          .parting = frame.pairs.empty() ? std::nullopt : frame.pairs.front().parting,
          .patches = frame.patches,
          .statistics = frame.statistics};
}

}  // namespace lodestone
