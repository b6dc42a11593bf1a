// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/random_rays.h"

#include <random>

namespace lodestone {

std::vector<Ray> random_rays(std::size_t count) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<float> unit(-1, 1);
  std::vector<Ray> rays;
  while (rays.size() < count) {
    const auto vector = [&] { return Eigen::Vector3d(unit(random), unit(random), unit(random)); };
    const Eigen::Vector3d origin = (rays.size() % 2 == 0 ? 2.0 : 0.5) * vector(), at = vector();
    const Eigen::Vector3d direction = (at - origin).cast<float>().cast<double>();
    if (!direction.isZero()) rays.push_back({origin, direction});
  }
  return rays;
}

std::vector<Point> random_ray_origins(std::size_t count) {
  std::vector<Point> points;
  for (const Ray& ray : random_rays(count)) points.emplace_back(ray.origin.x(), ray.origin.y(), ray.origin.z());
  return points;
}

}  // namespace lodestone
