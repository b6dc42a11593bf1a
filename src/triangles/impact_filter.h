// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>

#include "lodestone/triangles/impact.h"
#include "lodestone/triangles/moving_box.h"

namespace lodestone {

/// What floating point proves about two moving triangles in the time from 0 to `latest`. An answer `false` proves
/// nothing. Corners are counted from 0 to 5, as in `Exact_contacts`.
class Impact_filter {
 public:
  Impact_filter(const Moving_triangle& a, const Moving_triangle& b, double latest);

  /// Whether the triangles do not meet.
  bool are_apart() const { return !(overlap_from_ <= latest_); }
  /// Whether they do not meet at the start.
  bool are_apart_at_start() const { return overlap_from_ > 0; }

  /// Whether a corner does not come to a triangle.
  bool corner_and_face_apart(int corner, const std::array<int, 3>& face) const;
  /// Whether two edges do not meet.
  bool edges_apart(const std::array<int, 2>& first, const std::array<int, 2>& second) const;

 private:
  using Index = std::size_t;
  /// A corner at the start and at the end.
  struct Moving_corner {
    Eigen::Vector3d start, end;
  };
  struct Moving_difference {
    Eigen::Vector3d start, end;
    double size;  ///< largest component of both
  };

  const Moving_corner& corner(int index) const { return corners_[static_cast<Index>(index)]; }
  Moving_difference between(int from, int to) const;
  Moving_box box_around(std::span<const int> corners) const;
  bool boxes_apart(const Moving_box& a, const Moving_box& b) const;
  bool never_in_one_plane(int origin, int p, int q, int r) const;

  std::array<Moving_corner, 6> corners_;
  double latest_;
  double overlap_from_;
};

}  // namespace lodestone
