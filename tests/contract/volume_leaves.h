// SPDX-License-Identifier: GPL-3.0-or-later
// Leaves of every shape, size and position to fit volumes to, and points of their faces that the volumes must contain.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

// A new model needs its own `inside`.
#include "contract/volume_models.h"
#include "support/ball_membership.h"
#include "support/slab_membership.h"

namespace lodestone {

struct Volume_leaf {
  std::string name;
  Face_soup soup;  ///< at most 128 faces
};

/// The faces whose corners all satisfy a condition.
template <class Condition>
Face_soup faces_where(const Face_soup& soup, Condition condition) {
  Face_soup part = soup;
  std::erase_if(part.faces, [&](const Corners& face) {
    return !std::ranges::all_of(face, [&](std::uint32_t v) { return condition(soup.point(v)); });
  });
  return part;
}

inline Face_soup bent(Face_soup soup, auto map) {
  deform(soup, map);
  return soup;
}

/// Leaves within [-1, 1]^3 with a size of about 1, solid or at least not flat.
std::vector<Volume_leaf> solid_leaves();

/// The same without a volume: triangles, flat, straight and of a single point, with and without area.
std::vector<Volume_leaf> flat_leaves();

/// The position of a leaf: p becomes scale * (p + offset).
struct Placement {
  double scale = 1;
  std::array<double, 3> offset = {};

  Face_soup operator()(Face_soup soup) const {
    for (std::size_t i = 0; i < soup.coordinates.size(); ++i)
      soup.coordinates[i] = scale * (soup.coordinates[i] + offset[i % 3]);
    return soup;
  }
};

std::string text(const Placement& p);

bool finite(const Face_soup& soup);

std::vector<Placement> far_places();

/// Positions at which squares, cubes or sums of coordinates overflow, underflow or lose digits.
std::vector<Placement> extreme_scales();

Exact_point between(const Exact_point& p, const Exact_point& q, const Rational& t);

/// Midpoints of edges, points on edges and inside faces, and the points nearest to the given centres.
std::vector<Exact_point> points_of(const Triangle& face, const std::vector<Exact_point>& centres,
                                   std::mt19937_64& random);

/// Possible centres of a hole in a volume: the centre of the bounds, the mean of the vertices, and the centre of the
/// best-fitting sphere.
std::vector<Exact_point> likely_centres(const Face_soup& soup);

/// The centre of a volume that has one. A hole, if any, is around it.
template <class Volume>
std::vector<Exact_point> own_centres(const Volume& volume) {
  if constexpr (requires { volume.centre; })
    if (std::ranges::all_of(volume.centre, [](double x) { return std::isfinite(x); }))
      return {exact_point(volume.centre)};
  return {};
}

/// Whether a volume contains the corners of all faces, and other points of some faces, such as those nearest to the
/// volume's centre and to other points.
template <class Volume>
::testing::AssertionResult encloses(const Volume& volume, const Face_soup& soup, std::vector<Exact_point> centres,
                                    std::mt19937_64& random) {
  constexpr std::size_t looked_at = 10;
  for (const auto& centre : own_centres(volume)) centres.push_back(centre);
  std::vector<bool> seen(soup.vertex_count());
  for (const auto& face : soup.faces)
    for (const auto v : face) {
      if (!seen[v] && !inside(volume, exact_point(soup.point(v))))
        return ::testing::AssertionFailure() << "vertex " << v << " lies outside: " << soup.point(v);
      seen[v] = true;
    }
  for (std::size_t i = 0; i < std::min(looked_at, soup.faces.size()); ++i) {
    const std::size_t face = soup.faces.size() <= looked_at ? i : random() % soup.faces.size();
    for (const auto& p : points_of(soup.triangle(face), centres, random))
      if (!inside(volume, p))
        return ::testing::AssertionFailure()
               << "face " << face << " has a point outside, near " << CGAL::to_double(p.x()) << ' '
               << CGAL::to_double(p.y()) << ' ' << CGAL::to_double(p.z());
  }
  return ::testing::AssertionSuccess();
}

}  // namespace lodestone
