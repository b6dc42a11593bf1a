// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "lodestone/detection/frame.h"
#include "lodestone/queries/ray_search.h"
#include "lodestone/triangles/triangle_intersection.h"
#include "lodestone/volumes/aabb.h"

namespace lodestone {

/// Where a ray meets a face of one of several objects.
struct Object_hit {
  Object_id object = 0;  ///< its id
  Ray_hit hit = {};      ///< of a face of this object
};

/// An object, and a finite box around it.
struct Boxed_object {
  Object_id id;  ///< of the object
  Aabb box;      ///< around all of its faces
};

/// The first hits of some rays on an object, in their order.
using Ask_object = std::function<std::vector<std::optional<Ray_hit>>(Object_id, std::span<const Ray>)>;
/// Where a face of an object is now that has been asked.
using Face_of_object = std::function<Triangle(Object_id, std::uint32_t)>;

/// What each ray meets first among several objects; of several at the same t it is that of the lowest object, and of
/// this the lowest face.
///
/// Halves the objects again and again, and passes on the rays that may reach the box of a half before what they have
/// met so far: to that half first that more of them reach first. An object is asked about the rays that come to its own
/// box, each only as far as it can meet something first. O(n log n) for n objects, and some nanoseconds for each ray at
/// each box.
///
/// @param objects  in any order
/// @return one per ray, in their order
/// @throws Bad_argument  a ray is not as `Ray` says
std::vector<std::optional<Object_hit>> first_hits_among(std::span<const Ray> rays,
                                                        std::span<const Boxed_object> objects, const Ask_object& ask,
                                                        const Face_of_object& triangle_of);

}  // namespace lodestone
