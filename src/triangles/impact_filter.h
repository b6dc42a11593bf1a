// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "lodestone/triangles/impact.h"
#include "lodestone/triangles/moving_box.h"
#include "triangles/double_double.h"

namespace lodestone {

/// What floating point proves about features of two moving triangles. Corners are counted from 0 to 5, as in
/// `Exact_contacts`; edges likewise, edge i of a triangle from its corner i to the next. A bound is a lower bound on
/// the first time at which two features meet; infinity: not before `latest`, if at all.
class Impact_filter {
 public:
  Impact_filter(const Moving_triangle& a, const Moving_triangle& b, double latest);

  /// The bound for a corner of one triangle and the whole other one.
  double corner_and_face(int corner) const;
  /// The bound for an edge of each triangle.
  double edges(int first, int second) const;

  /// Whether a corner and the other triangle are proven apart all the time from their bound until another time. The
  /// proof is in double-double, so it succeeds until nearly the time at which they meet.
  bool corner_and_face_apart(int corner, double bound, const Double_double& until) const;
  bool edges_apart(int first, int second, double bound, const Double_double& until) const;

 private:
  using Index = std::size_t;
  struct Moving_corner {
    Eigen::Vector3d start, end;
  };
  template <class Number>
  struct Moving_difference {
    Eigen::Matrix<Number, 3, 1> start, end;
    double size;  ///< largest component of both
  };
  /// Four corners. Of a corner and a triangle the corner comes first, of two edges the ends of one.
  struct Features {
    bool are_edges;
    std::array<int, 4> corners;
  };
  template <class Number>
  using Quadratic = std::array<Eigen::Matrix<Number, 3, 1>, 3>;
  template <class Number>
  class Volume;
  template <class Number>
  class Piece;

  template <class Number>
  static Quadratic<Number> area(const Moving_difference<Number>& p, const Moving_difference<Number>& q);

  static Features features_of_corner(int corner);
  static Features features_of_edges(int first, int second);
  template <class Number>
  Moving_difference<Number> between(int from, int to) const;
  template <class Number>
  std::array<Moving_difference<Number>, 3> differences(const Features& features) const;
  Moving_box box_around(int first, int second) const;
  double first_possible(const Features& features) const;
  bool apart(const Features& features, double from, const Double_double& until) const;

  double latest_;
  std::array<Moving_corner, 6> corners_;
  std::array<Moving_box, 6> edge_boxes_;
  std::array<Moving_box, 2> face_boxes_;
};

}  // namespace lodestone
