// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangles/orientation.h"

#include <algorithm>
#include <boost/container/static_vector.hpp>

#include "triangles/orientation_kernel.h"

namespace lodestone {

namespace {

/// No sign: what CGAL's filter has not decided.
constexpr auto undecided = static_cast<CGAL::Sign>(-2);

struct Filter_alone : Kernel {
  struct Orientation_3 {
    using result_type = CGAL::Sign;
    CGAL::Sign operator()(const Point&, const Point&, const Point&, const Point&) const { return undecided; }
  };
};
using Orientation_filter = CGAL::internal::Static_filters_predicates::Orientation_3<Filter_alone>;

CGAL::Sign filtered_orientation(const Point_quadruple& points) {
  return Orientation_filter()(*points[0], *points[1], *points[2], *points[3]);
}

/// Quadruples that the filter has not decided.
class Undecided_quadruples {
 public:
  void add(const Point_quadruple& points, CGAL::Sign& sign) { listed_.push_back({&points, &sign}); }

  /// Writes their signs.
  void decide() {
    if (listed_.empty()) return;
    kernel::Point_quadruples sets;
    for (const auto& [points, sign] : listed_) {
      for (int i = 0; i < 4; ++i)
        for (int axis = 0; axis < 3; ++axis) sets.points[i][axis][sets.count] = (*(*points)[i])[axis];
      ++sets.count;
    }
    double signs[most_orientations];
    kernel::orientation_signs(sets, signs);
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      const auto& [p, q, r, s] = *listed_[i].points;
      *listed_[i].sign = signs[i] == 0 ? CGAL::orientation(*p, *q, *r, *s) : CGAL::sign(signs[i]);
    }
  }

 private:
  struct Listed {
    const Point_quadruple* points;
    CGAL::Sign* sign;
  };
  boost::container::static_vector<Listed, most_orientations> listed_;
};

}  // namespace

void orientations(std::span<const Point_quadruple> quadruples, std::span<CGAL::Sign> signs) {
  Undecided_quadruples left;
  for (std::size_t i = 0; i < quadruples.size(); ++i) {
    signs[i] = filtered_orientation(quadruples[i]);
    if (signs[i] == undecided) left.add(quadruples[i], signs[i]);
  }
  left.decide();
}

bool all_positive(std::span<const Point_quadruple> quadruples) {
  Undecided_quadruples left;
  std::array<CGAL::Sign, most_orientations> signs;
  for (std::size_t i = 0; i < quadruples.size(); ++i) {
    signs[i] = filtered_orientation(quadruples[i]);
    if (signs[i] == undecided)
      left.add(quadruples[i], signs[i]);
    else if (signs[i] != CGAL::POSITIVE)
      return false;
  }
  left.decide();
  return std::ranges::count(std::span(signs).first(quadruples.size()), CGAL::POSITIVE) == std::ssize(quadruples);
}

CGAL::Sign doubtful_orientation(const Point& p, const Point& q, const Point& r, const Point& s) {
  const Point_quadruple points{&p, &q, &r, &s};
  CGAL::Sign sign;
  Undecided_quadruples alone;
  alone.add(points, sign);
  alone.decide();
  return sign;
}

}  // namespace lodestone
