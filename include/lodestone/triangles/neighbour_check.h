// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/pairs.h"
#include "lodestone/mesh/vertex_fans.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

/// Whether two faces of one mesh intersect: whether they have a point in common that lies on no vertex and no edge that
/// both have, by vertex index. Exact for any finite coordinates.
///
/// Faces with an area intersect exactly when CGAL's `self_intersections` reports them (Polygon mesh processing 5.5). So
/// two faces with the same three vertices intersect. A face without an area counts as the segment or point that it is.
/// It intersects another face if it passes through it, or overlaps it outside of what both share. It does not intersect
/// if it only closes a gap along an edge. CGAL reports each face without an area once, as a pair with itself, and tests
/// no other pair with it.
///
/// @param corners_a, corners_b  vertex indices of the faces
/// @param a, b                  positions of these vertices
bool faces_intersect(const Corners& corners_a, const Triangle& a, const Corners& corners_b, const Triangle& b);

/// Finds the intersecting pairs among the faces that share a vertex. Holds its working memory, so each thread needs one
/// of its own.
class Neighbour_check {
 public:
  /// Appends to `found`, in no particular order, the intersecting pairs, a < b, whose lowest common vertex is in
  /// [first, last). Disjoint ranges that cover all vertices find each pair once.
  ///
  /// A vertex whose faces lie side by side, seen from some direction, costs O(its faces). That is nearly every vertex
  /// of a smooth surface. Around the others all pairs are tested, most of them in floating point only.
  ///
  /// @param fans, faces  of the mesh
  /// @param positions    three coordinates per vertex, all finite
  void check(const Vertex_fans& fans, std::span<const Corners> faces, std::span<const double> positions,
             std::uint32_t first, std::uint32_t last, std::vector<Face_pair>& found);

  /// Face pairs that went to the exact test since `reset_count`.
  std::size_t exact_tests() const { return exact_tests_; }
  /// Sets `exact_tests` to 0.
  void reset_count() { exact_tests_ = 0; }

 private:
  /// A face as seen from the current vertex.
  struct Wing {
    std::uint32_t face;
    std::array<std::uint32_t, 2> ends;    ///< the other corners
    std::array<Eigen::Vector3d, 2> arms;  ///< to them
    std::array<double, 2> reach;          ///< largest absolute coordinate of each arm
    Eigen::Vector3d normal;               ///< cross product of the arms
    double area;                          ///< product of the reaches; infinite if it cannot bound errors
  };

  static Wing make_wing(const double* positions, const Corners& corners, std::uint32_t face, std::uint32_t vertex);
  static bool surely_beside(const Wing& a, const Wing& b);
  static bool surely_beside_along_an_axis(const Wing& a, const Wing& b);
  static bool surely_hinged(const Wing& a, const Wing& b, int other_of_a, int other_of_b);
  void check_pairs(std::uint32_t vertex, std::span<const std::uint32_t> fan, std::span<const Corners> faces,
                   const double* positions, std::vector<Face_pair>& found);

  std::vector<Wing> wings_;
  std::size_t exact_tests_ = 0;
};

}  // namespace lodestone
