// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "lodestone/io/motion/motion.h"
#include "lodestone/mesh/concepts.h"

namespace lodestone {

/// Two spheres of the same number of triangles that wobble and are moved into each other.
class Moving_pair {
 public:
  /// @param triangles  of both together, met nearly
  explicit Moving_pair(std::size_t triangles);
  Moving_pair(const Moving_pair&) = delete;
  Moving_pair& operator=(const Moving_pair&) = delete;

  /// How deep the second is in the first.
  enum class Place {
    apart,  ///< a hundredth of a radius between the two
    sunk,   ///< a third of a radius deep
    inside  ///< half as large, and in the middle
  };
  /// Poses both.
  void pose(std::size_t frame, Place place);

  /// The two meshes in their current pose.
  const std::array<Surface_mesh, 2>& meshes() const { return meshes_; }
  /// Triangles of both.
  std::size_t triangles() const { return meshes_[0].number_of_faces() + meshes_[1].number_of_faces(); }

 private:
  std::array<Surface_mesh, 2> meshes_;
  std::array<Motion, 2> motions_;
  std::vector<Point> positions_;
};

}  // namespace lodestone
