// SPDX-License-Identifier: GPL-3.0-or-later
#include "partition/lathe.h"

namespace lodestone {

Surface_mesh lathe(const std::vector<Profile_point>& profile, std::uint32_t around, double cap) {
  std::vector<Point> points;
  for (const auto& [x, radius] : profile)
    for (std::uint32_t i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around;
      points.emplace_back(x, radius * std::cos(angle), radius * std::sin(angle));
    }
  const auto rings = static_cast<std::uint32_t>(profile.size());
  const std::uint32_t first_pole = rings * around, last_pole = first_pole + 1;
  points.emplace_back(profile.front().x - cap, 0, 0);
  points.emplace_back(profile.back().x + cap, 0, 0);

  std::vector<Corners> faces;
  for (std::uint32_t i = 0; i < around; ++i) {
    const std::uint32_t next = (i + 1) % around;
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
      const std::uint32_t low = ring * around, high = low + around;
      faces.push_back({low + i, low + next, high + next});
      faces.push_back({low + i, high + next, high + i});
    }
    faces.push_back({first_pole, next, i});
    faces.push_back({last_pole, (rings - 1) * around + i, (rings - 1) * around + next});
  }
  return mesh_of(points, faces);
}

Surface_mesh dumbbell(double left, double right, double bridge, std::uint32_t around, int parts) {
  std::vector<Profile_point> profile;
  const auto ball = [&](double radius, bool from_pole, double centre) {
    const double join = std::asin(bridge / radius);
    for (int i = 1; i <= parts; ++i) {
      const double share = static_cast<double>(from_pole ? i : parts + 1 - i) / parts;
      const double angle = share * (std::numbers::pi - join);
      profile.push_back({centre - (from_pole ? 1 : -1) * radius * std::cos(angle), radius * std::sin(angle)});
    }
  };
  ball(left, true, -1 - left * std::sqrt(1 - bridge * bridge / left / left));
  for (int i = 1; i < 6; ++i) profile.push_back({-1 + i / 3.0, bridge});
  ball(right, false, 1 + right * std::sqrt(1 - bridge * bridge / right / right));
  return lathe(profile, around, 0.02);
}

}  // namespace lodestone
