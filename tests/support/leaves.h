// SPDX-License-Identifier: GPL-3.0-or-later
// Leaves to fit volumes to.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "lodestone/volumes/leaf_faces.h"

namespace lodestone {

/// A leaf that owns its data.
struct Leaf {
  std::vector<double> coordinates;
  std::vector<std::uint32_t> vertices;
  std::vector<Leaf_corners> corners;

  Leaf_faces faces() const { return {coordinates, vertices, corners}; }
  Eigen::Vector3d point(std::size_t place) const { return Eigen::Map<const Eigen::Vector3d>(faces().position(place)); }
  void add(const Eigen::Vector3d& p) {
    vertices.push_back(static_cast<std::uint32_t>(vertices.size()));
    coordinates.insert(coordinates.end(), p.begin(), p.end());
  }
};

/// Points of which every three in a row are a face.
Leaf strip(const std::vector<Eigen::Vector3d>& points);

template <class Volume>
Volume volume_of(const Leaf& leaf) {
  Volume volume;
  volume.enclose(leaf.faces());
  return volume;
}

template <class Volume>
Volume volume_of(const std::vector<Eigen::Vector3d>& points) {
  return volume_of<Volume>(strip(points));
}

template <class Volume>
Volume volume_of(const Volume& a, const Volume& b) {
  Volume volume;
  volume.enclose(a, b);
  return volume;
}

Eigen::Vector3d random_vector(std::mt19937_64& random);

Eigen::Vector3d vector_in_cube(std::mt19937_64& random);

Eigen::Matrix3d random_turn(std::mt19937_64& random);

/// Corners of a box whose sides are along the columns of `axes`: corner k is on the upper side of axis i where bit i
/// of k is set.
std::vector<Eigen::Vector3d> box_corners(const Eigen::Vector3d& half, const Eigen::Matrix3d& axes,
                                         const Eigen::Vector3d& centre = {0, 0, 0});

/// Random points in a rotated box of the given half-widths about a centre; half-widths may be 0.
std::vector<Eigen::Vector3d> points_in_box(std::size_t count, const Eigen::Vector3d& half,
                                           const Eigen::Vector3d& centre, std::mt19937_64& random);

/// A square grid of side 1 about the origin in the plane z = 0, each point of which `map` moves.
template <class Map>
Leaf grid(int a, int b, Map map) {
  Leaf leaf;
  const auto place = [b](int i, int j) { return static_cast<std::uint16_t>(i * b + j); };
  for (int i = 0; i < a; ++i)
    for (int j = 0; j < b; ++j) {
      leaf.add(map(Eigen::Vector3d((i + 0.5) / a - 0.5, (j + 0.5) / b - 0.5, 0)));
      if (i == 0 || j == 0) continue;
      leaf.corners.push_back({place(i - 1, j - 1), place(i, j - 1), place(i, j)});
      leaf.corners.push_back({place(i - 1, j - 1), place(i, j), place(i - 1, j)});
    }
  return leaf;
}

/// Onto the sphere of a radius that touches the plane z = 0 from below, at the origin.
Eigen::Vector3d onto_sphere(const Eigen::Vector3d& p, double radius);

struct Named_leaf {
  std::string name;
  Leaf leaf;
};

/// Typical and degenerate leaves, with about 60 vertices and a size of about 1.
std::vector<Named_leaf> leaf_cases();

/// Coordinates times a factor, plus an offset.
Leaf placed(Leaf leaf, double factor, double offset = 0);

/// The cases near the origin, far from it, and of extreme size.
template <class Check>
void for_placed_leaves(const Check& check) {
  for (const auto& [name, leaf] : leaf_cases())
    for (const auto& [factor, offset] : std::vector<std::pair<double, double>>{{1, 0},
                                                                               {1, 0x1p20},
                                                                               {0x1p-30, 0x1p20},
                                                                               {0x1p-300, 0},
                                                                               {0x1p300, 0},
                                                                               {0x1p-1060, 0},
                                                                               {0x1p1021, 0},
                                                                               {0x1p-600, 0x1p-560},
                                                                               {0x1p500, 0x1p530}}) {
      SCOPED_TRACE(name + ", times " + std::to_string(std::ilogb(factor)) + ", at " + std::to_string(offset));
      check(placed(leaf, factor, offset));
    }
}

/// Solid, flat and straight leaves, and single points, of every size, about the origin and far from it.
std::vector<Named_leaf> hard_leaves();

}  // namespace lodestone
