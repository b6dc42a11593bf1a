// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "lodestone/triangles/impact.h"
#include "lodestone/triangles/moving_box.h"

namespace lodestone {

/// What floating point proves about features of two moving triangles. Corners are counted from 0 to 5, as in
/// `Exact_contacts`; edges likewise, edge i of a triangle from its corner i to the next. Each answer is a lower bound
/// on the first time at which two features meet; infinity: not before `latest`, if at all.
class Impact_filter {
 public:
  Impact_filter(const Moving_triangle& a, const Moving_triangle& b, double latest);

  /// For a corner of one triangle and the whole other one.
  double corner_and_face(int corner) const;
  /// For an edge of each triangle.
  double edges(int first, int second) const;

 private:
  using Index = std::size_t;
  struct Moving_corner {
    Eigen::Vector3d start, end;
  };
  struct Moving_difference {
    Eigen::Vector3d start, end;
    double size;  ///< largest component of both
  };
  enum class Features { corner_and_face, edges };
  class Piece;

  Moving_difference between(int from, int to) const;
  Moving_box box_around(int first, int second) const;
  double first_possible(Features features, int origin, int p, int q, int r) const;

  double latest_;
  std::array<Moving_corner, 6> corners_;
  std::array<Moving_box, 6> edge_boxes_;
  std::array<Moving_box, 2> face_boxes_;
};

}  // namespace lodestone
