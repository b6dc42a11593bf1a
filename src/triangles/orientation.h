// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>

#include "lodestone/mesh/concepts.h"
#include "triangles/most_planes.h"

// Last, since it needs the kernel's headers.
#include <CGAL/Filtered_kernel/internal/Static_filters/Orientation_3.h>

namespace lodestone {

/// The orientation test of CGAL's kernel in three stages, with its answers: CGAL's filter in doubles, then
/// double-double, then CGAL's exact numbers. The second stage decides what lies in a plane but for rounding, such as a
/// sheet at rest on a slope. It takes several sets of four points at once.

/// Four points whose orientation is asked for.
using Point_quadruple = std::array<const Point*, 4>;

/// So many are decided at once.
inline constexpr std::size_t most_orientations = kernel::most_planes;

/// `CGAL::orientation` of each.
/// @param quadruples  at most `most_orientations`
/// @param signs       as many; written
void orientations(std::span<const Point_quadruple> quadruples, std::span<CGAL::Sign> signs);
template <std::size_t count>
std::array<CGAL::Sign, count> orientations(const std::array<Point_quadruple, count>& quadruples) {
  std::array<CGAL::Sign, count> signs;
  orientations(quadruples, signs);
  return signs;
}

/// Whether all of at most `most_orientations` are positive.
bool all_positive(std::span<const Point_quadruple> quadruples);

/// `CGAL::orientation` of points that CGAL's filter has not decided.
CGAL::Sign doubtful_orientation(const Point& p, const Point& q, const Point& r, const Point& s);

/// The kernel, with the orientation test of three stages: for algorithms of CGAL's.
struct Staged_kernel : Kernel {
  struct After_filter : Kernel {
    struct Orientation_3 : Kernel::Orientation_3 {
      using Kernel::Orientation_3::operator();
      CGAL::Sign operator()(const Point& p, const Point& q, const Point& r, const Point& s) const {
        return doubtful_orientation(p, q, r, s);
      }
    };
  };
  using Orientation_3 = CGAL::internal::Static_filters_predicates::Orientation_3<After_filter>;

  Orientation_3 orientation_3_object() const { return {}; }
};

/// The same of one set of points.
inline CGAL::Sign orientation(const Point& p, const Point& q, const Point& r, const Point& s) {
  return Staged_kernel::Orientation_3()(p, q, r, s);
}

}  // namespace lodestone
