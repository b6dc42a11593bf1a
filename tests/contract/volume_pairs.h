// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs of leaves that just meet or are just apart.
#pragma once

#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "contract/volume_leaves.h"
#include "lodestone/triangles/triangle_distance.h"
#include "support/distance_oracle.h"
#include "support/hard_pairs.h"

namespace lodestone {

std::string text(const Face_soup& soup);

Triangle placed(const Triangle& t, const Placement& place);

bool finite(const Triangle& t);

/// Mostly unchanged; sometimes far from the origin, or in units where squares overflow or underflow.
Placement any_placement(std::mt19937_64& random);

/// The image of a soup under point reflection in one of its vertices, which both share. At a corner of the convex hull,
/// a tight volume around one of them ends there or just beyond.
Face_soup mirrored(Face_soup soup, std::uint32_t vertex);

/// A triangle of any shape within [-1, 1]^3.
Triangle any_triangle(std::mt19937_64& random);

/// 2 to 30 neighbouring faces of several kinds of surfaces, randomly rotated, within about [-1, 1]^3; no other
/// vertices.
class Face_groups {
 public:
  Face_soup operator()(std::mt19937_64& random) const {
    const Face_soup& source = sources_[random() % sources_.size()];
    const std::size_t count = 2 + random() % 29, first = random() % (source.faces.size() - count);
    std::vector<Triangle> triangles;
    for (std::size_t f = first; f < first + count; ++f) triangles.push_back(source.triangle(f));
    const auto group = soup_of(triangles);
    return random() % 3 == 0 ? group : posed_at_random(group, 0, random);
  }

 private:
  std::vector<Face_soup> sources_{
      icosphere(4),
      placed(icosphere(2), 0.4),
      crumpled(icosphere(3), 0.1, 1),
      placed(cloth(9, 8), 1, -0.5),
      bent(cloth(9, 8), [](const Point& p) { return Point(p.x() - 0.5, p.y() - 0.5, p.x() * p.y()); }),
      placed(lattice_soup(200, 60, 5, 2), 0.25, -0.5),
      loose_triangles(60, 0.3, 3),
      placed(cube(4), 1, -0.5)};
};

/// Whether two soups have faces that intersect, and whether they have faces no farther apart than `margin`: exact.
bool soups_meet(const Face_soup& a, const Face_soup& b);
bool within_margin(const Triangle& a, const Triangle& b, double margin);
bool within_margin(const Face_soup& a, const Face_soup& b, double margin);

/// An upper bound of the distance of two points, at most a few units in the last place above it.
double distance_rounded_up(const Point& p, const Point& q);

}  // namespace lodestone
