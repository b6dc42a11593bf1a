// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "lodestone/mesh/pairs.h"
#include "lodestone/queries/ray_search.h"
#include "lodestone/triangles/triangle_intersection.h"
#include "lodestone/volumes/aabb.h"

namespace lodestone {

/// Where a ray meets a face of one of several objects.
struct Object_hit {
  Object_id object = 0;
  Ray_hit hit = {};  ///< of a face of this object
};

/// The first hits of rays among several objects, which are shown one after the other, in ascending order. Each is asked
/// only about the rays that may meet it before what they have met so far, and only as far as that.
class First_of_objects {
 public:
  /// Where a face of an object that has been shown is now.
  using Triangle_of = std::function<Triangle(Object_id, std::uint32_t face)>;

  /// @param rays  must outlive this
  /// @throws Bad_argument  a ray is not as `Ray` says
  First_of_objects(std::span<const Ray> rays, Triangle_of triangle_of);
  First_of_objects(const First_of_objects&) = delete;
  ~First_of_objects();

  /// The rays to ask the next object about. O(rays), some nanoseconds for each.
  /// @param box  around the object
  /// @return valid until the next call; empty: the object is of no use
  std::span<const Ray> rays_to(const Aabb& box);
  /// Takes the first hits of these rays on the object.
  void take(Object_id object, std::span<const std::optional<Ray_hit>> hits);

  /// Per ray: its first hit; of several at the same t that of the lowest object, and of this the lowest face.
  std::vector<std::optional<Object_hit>> take_result() { return std::move(found_); }

 private:
  class Way;

  bool is_earlier(std::size_t ray, Object_id object, const Ray_hit& hit) const;

  Triangle_of triangle_of_;
  std::vector<Way> ways_;
  std::vector<std::optional<Object_hit>> found_;
  std::vector<Ray> asked_;
  std::vector<std::size_t> asked_indices_;  ///< among all rays
};

}  // namespace lodestone
