// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/leaves.h"

namespace lodestone {

Leaf strip(const std::vector<Eigen::Vector3d>& points) {
  Leaf leaf;
  for (const auto& p : points) leaf.add(p);
  const auto last = static_cast<std::uint16_t>(points.size() - 1);
  const auto place = [last](std::size_t i) { return std::min(static_cast<std::uint16_t>(i), last); };
  for (std::size_t i = 0; i == 0 || i + 2 < points.size(); ++i)
    leaf.corners.push_back({place(i), place(i + 1), place(i + 2)});
  return leaf;
}

Eigen::Vector3d random_vector(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return {x, y, z};
}

Eigen::Vector3d vector_in_cube(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const double x = unit(random), y = unit(random), z = unit(random);
  return {x, y, z};
}

Eigen::Matrix3d random_turn(std::mt19937_64& random) {
  return Eigen::AngleAxisd(4 * vector_in_cube(random).x(), vector_in_cube(random).normalized()).toRotationMatrix();
}

std::vector<Eigen::Vector3d> box_corners(const Eigen::Vector3d& half, const Eigen::Matrix3d& axes,
                                         const Eigen::Vector3d& centre) {
  std::vector<Eigen::Vector3d> corners;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d side(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
    corners.push_back(centre + axes * half.cwiseProduct(side));
  }
  return corners;
}

std::vector<Eigen::Vector3d> points_in_box(std::size_t count, const Eigen::Vector3d& half,
                                           const Eigen::Vector3d& centre, std::mt19937_64& random) {
  const Eigen::Matrix3d turn = random_turn(random);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t k = 0; k < count; ++k)
    points.push_back(centre + turn * half.cwiseProduct(vector_in_cube(random)).eval());
  return points;
}

Eigen::Vector3d onto_sphere(const Eigen::Vector3d& p, double radius) {
  const Eigen::Vector3d centre(0, 0, -radius);
  return centre + radius * (p - centre).normalized();
}

std::vector<Named_leaf> leaf_cases() {
  std::mt19937_64 random(1);
  const auto plain = [](const Eigen::Vector3d& p) { return p; };
  const auto sphere = [](double radius) { return [radius](const auto& p) { return onto_sphere(p, radius); }; };
  const auto rough = [&](double height) {
    return [&random, height](const auto& p) -> Eigen::Vector3d { return p + height * random_vector(random); };
  };
  const auto tube = [](const auto& p) {
    return Eigen::Vector3d(p.x(), 0.1 * std::cos(6.3 * p.y()), 0.1 * std::sin(6.3 * p.y()));
  };
  const auto saddle = [](const auto& p) { return Eigen::Vector3d(p.x(), p.y(), p.x() * p.x() - p.y() * p.y()); };
  std::vector<Eigen::Vector3d> anywhere(60);
  for (auto& p : anywhere) p = random_vector(random);
  std::vector<Eigen::Vector3d> collinear(20);
  for (auto& p : collinear) p = anywhere[0] + anywhere[1] * anywhere[static_cast<std::size_t>(&p - &collinear[0])].x();
  return {{"flat", grid(8, 8, plain)},
          {"of a sphere", grid(8, 8, sphere(2))},
          {"of a large sphere", grid(8, 8, sphere(50))},
          {"half a sphere", grid(8, 8, sphere(0.4))},
          {"rough", grid(8, 8, rough(0.02))},
          {"very rough", grid(8, 8, rough(0.3))},
          {"tube", grid(10, 7, tube)},
          {"saddle", grid(8, 8, saddle)},
          {"strip", grid(30, 2, plain)},
          {"anywhere", strip(anywhere)},
          {"collinear", strip(collinear)},
          {"triangle", strip({anywhere[0], anywhere[1], anywhere[2]})},
          {"two points", strip({anywhere[0], anywhere[1]})},
          {"a point", strip({anywhere[0]})},
          {"the same point", strip({anywhere[0], anywhere[0], anywhere[0], anywhere[0]})}};
}

Leaf placed(Leaf leaf, double factor, double offset) {
  for (double& x : leaf.coordinates) x = factor * x + offset;
  return leaf;
}

std::vector<Named_leaf> hard_leaves() {
  std::mt19937_64 random(7);
  std::vector<Named_leaf> leaves;
  const Eigen::Vector3d shapes[]{{1, 0.6, 0.2}, {1, 0.4, 1e-9}, {1, 0.7, 0}, {1, 0, 0}, {0, 0, 0}};
  for (const double scale : {1.0, 0x1p-300, 0x1p300, 1e307, 1.7e308, 1e-307, 0x1p-1070, 1e150, 1e-160})
    for (const double offset : {0.0, 1.0, 0x1p20, 1e6})
      for (const auto& shape : shapes)
        for (const std::size_t count : {1, 3, 8, 9, 17, 60}) {
          if (!std::isfinite(scale * (offset + 1))) continue;
          const Eigen::Vector3d centre = offset * Eigen::Vector3d(1, -0.7, 0.3);
          auto points = points_in_box(count, 0.5 * shape, centre, random);
          for (auto& p : points) p *= scale;
          leaves.push_back({"scale " + std::to_string(std::log2(scale)) + ", offset " + std::to_string(offset) + ", " +
                                std::to_string(count) + " vertices",
                            strip(points)});
        }
  return leaves;
}

}  // namespace lodestone
