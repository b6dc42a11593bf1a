// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include "lodestone/triangles/impact.h"
#include "triangles/algebraic_time.h"

namespace lodestone {

/// Finds, in exact numbers, when corners, edges and faces of two moving triangles meet first.
///
/// Corners are counted from 0 to 5: three of the first triangle, then three of the second.
class Exact_contacts {
 public:
  /// @param before  if not null, only earlier times count
  Exact_contacts(const Moving_triangle& a, const Moving_triangle& b, const Impact_time* before = nullptr);

  /// Looks for when a corner is first on a triangle.
  /// @param face  its three corners
  void try_corner_and_face(int corner, const std::array<int, 3>& face);
  /// Looks for when two edges first have a point in common.
  void try_edges(const std::array<int, 2>& first, const std::array<int, 2>& second);

  /// The first time that has been found; null: none.
  const Algebraic_time* first() const { return found_ ? &*before_ : nullptr; }
  /// What begins later than this does not count: the least double that is not below `first`, or the given time;
  /// infinite if there is neither.
  double latest() const { return latest_; }

 private:
  void try_corner_and_edge(int corner, const std::array<int, 2>& edge);
  void try_corners(int first, int second);

  template <class Meets>
  void try_roots(const Integer_polynomial& p, Meets meets);

  bool on_face(int corner, const std::array<int, 3>& face, Algebraic_time& t) const;
  bool edges_meet(const std::array<int, 2>& first, const std::array<int, 2>& second, Algebraic_time& t) const;
  bool on_edge(int corner, const std::array<int, 2>& edge, Algebraic_time& t) const;

  Moving_vector between(int from, int to) const { return point(to) - point(from); }
  const Moving_vector& point(int corner) const { return points_[static_cast<std::size_t>(corner)]; }

  std::array<Moving_vector, 6> points_;
  std::optional<Algebraic_time> before_;  ///< only earlier times count: the first that was found, or the given one
  double latest_;
  bool found_ = false;
};

}  // namespace lodestone
