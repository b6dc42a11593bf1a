// SPDX-License-Identifier: GPL-3.0-or-later
// Leaves to fit volumes to.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "lodestone/contact/leaf_faces.h"

namespace lodestone {

/// Vertices of a leaf; every three of them in a row are a face.
struct Point_leaf {
  std::string name;
  std::vector<double> coordinates;
  std::vector<std::uint32_t> vertices;
  std::vector<Leaf_corners> corners;

  explicit Point_leaf(const std::vector<Eigen::Vector3d>& points, std::string called = {}) : name(std::move(called)) {
    for (const auto& p : points) coordinates.insert(coordinates.end(), {p.x(), p.y(), p.z()});
    vertices.resize(points.size());
    std::iota(vertices.begin(), vertices.end(), 0u);
    for (std::size_t k = 0; k + 2 < points.size(); ++k)
      corners.push_back(
          {static_cast<std::uint16_t>(k), static_cast<std::uint16_t>(k + 1), static_cast<std::uint16_t>(k + 2)});
  }
  Leaf_faces faces() const { return {coordinates, vertices, corners}; }
  Eigen::Vector3d point(std::size_t k) const {
    return {coordinates[3 * k], coordinates[3 * k + 1], coordinates[3 * k + 2]};
  }
};

inline Eigen::Vector3d vector_in_cube(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const double x = unit(random), y = unit(random), z = unit(random);
  return {x, y, z};
}

inline Eigen::Matrix3d random_turn(std::mt19937_64& random) {
  return Eigen::AngleAxisd(4 * vector_in_cube(random).x(), vector_in_cube(random).normalized()).toRotationMatrix();
}

/// As many points in a turned box of the given half widths about a centre, some of which may be 0.
inline std::vector<Eigen::Vector3d> points_in_box(std::size_t count, const Eigen::Vector3d& half,
                                                  const Eigen::Vector3d& centre, std::mt19937_64& random) {
  const Eigen::Matrix3d turn = random_turn(random);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t k = 0; k < count; ++k)
    points.push_back(centre + turn * half.cwiseProduct(vector_in_cube(random)).eval());
  return points;
}

/// Bodies, flat and straight ones, and single points, of every size, about the origin and far from it.
inline std::vector<Point_leaf> hard_leaves() {
  std::mt19937_64 random(7);
  std::vector<Point_leaf> leaves;
  const Eigen::Vector3d shapes[]{{1, 0.6, 0.2}, {1, 0.4, 1e-9}, {1, 0.7, 0}, {1, 0, 0}, {0, 0, 0}};
  for (const double scale : {1.0, 0x1p-300, 0x1p300, 1e307, 1.7e308, 1e-307, 0x1p-1070, 1e150, 1e-160})
    for (const double offset : {0.0, 1.0, 0x1p20, 1e6})
      for (const auto& shape : shapes)
        for (const std::size_t count : {1, 3, 8, 9, 17, 60}) {
          if (!std::isfinite(scale * (offset + 1))) continue;
          const Eigen::Vector3d centre = offset * Eigen::Vector3d(1, -0.7, 0.3);
          auto points = points_in_box(count, 0.5 * shape, centre, random);
          for (auto& p : points) p *= scale;
          leaves.emplace_back(points, "scale " + std::to_string(std::log2(scale)) + ", offset " +
                                          std::to_string(offset) + ", " + std::to_string(count) + " vertices");
        }
  return leaves;
}

}  // namespace lodestone
