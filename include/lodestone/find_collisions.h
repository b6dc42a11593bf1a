// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "lodestone/detector.h"

namespace lodestone {

/// What `find_collisions` found.
struct Collisions {
  bool collide = false;
  std::vector<Face_pair> faces;             ///< intersecting faces of a and b, sorted
  std::vector<Intersection_points> points;  ///< parallel to `faces`: where they meet; empty unless asked for
  Frame_statistics statistics = {};
};

/// Finds collisions between two meshes with one call: partition, walk, check.
///
/// Whatever is reported is true, by exact predicates. A collision can be missed: see the modes of `Detector`. Faces are
/// numbered in the order of `faces(mesh)`. To follow meshes that move, keep a `Detector`: most of the time goes into
/// the partition, which it makes once.
///
/// @throws Bad_mesh      no face, a face that is no triangle, a coordinate that is not finite
/// @throws Bad_argument  an option out of range, or one mesh given twice
template <Triangle_mesh Mesh>
Collisions find_collisions(const Mesh& a, const Mesh& b, const Detector_options& options = {}) {
  Detector<Mesh> detector(options);
  detector.add(a);
  detector.add(b);
  const Frame& frame = detector.detect();
  return {.collide = frame.collides(),
          .faces = frame.face_pairs,
          .points = frame.contact_points,
          .statistics = frame.statistics};
}

}  // namespace lodestone
