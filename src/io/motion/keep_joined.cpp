// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/motion/keep_joined.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lodestone/mesh/errors.h"

namespace lodestone {
namespace {

double size_of(const Point& p) { return std::max({std::abs(p.x()), std::abs(p.y()), std::abs(p.z())}); }

bool are_near(const Point& p, const Point& q, double distance) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(p[axis] - q[axis]) <= distance)) return false;
  return true;
}

struct Joined_pair {
  std::uint32_t vertex, first;
};

struct Joined_pairs {
  std::vector<Joined_pair> pairs;
  std::string mesh;

  /// Apart by more than what is rounded to floats.
  void check(std::size_t frame, std::span<const Point> positions) const {
    double largest = 0;
    for (const auto [vertex, first] : pairs) largest = std::max(largest, size_of(positions[first]));
    for (const auto [vertex, first] : pairs)
      if (!are_near(positions[vertex], positions[first], 0x1p-21 * largest))
        throw Bad_motion(fmt::format(
            "{}: vertices {} and {} (counted from 0) are one vertex there, since they are at one place, but "
            "frame {} of the motion moves them apart: export the mesh in a format that keeps them, such as "
            ".obj",
            mesh, first, vertex, frame));
  }
};

/// Pairs that the motion itself does not keep together.
std::vector<Joined_pair> pairs_to_check(const Joined_vertices& joined, const Joined_vertices& by_motion) {
  std::vector<Joined_pair> pairs;
  for (std::uint32_t vertex = 0; vertex < joined.size(); ++vertex) {
    const std::uint32_t first = joined[vertex];
    if (first != vertex && (by_motion.empty() || by_motion[vertex] != by_motion[first]))
      pairs.push_back({vertex, first});
  }
  return pairs;
}

Motion checked(Motion motion, std::shared_ptr<const Joined_pairs> pairs) {
  motion.pose = [inner = std::move(motion.pose), pairs](std::size_t frame, std::span<Point> positions) {
    inner(frame, positions);
    pairs->check(frame, positions);
  };
  motion.computed = {};  // only a whole frame can be checked
  if (motion.resampled)
    motion.resampled = [inner = std::move(motion.resampled), pairs](double rate, double start) {
      return checked(inner(rate, start), pairs);
    };
  return motion;
}

}  // namespace

Motion keep_joined(Motion motion, const Joined_vertices& joined, const std::filesystem::path& mesh) {
  auto pairs = pairs_to_check(joined, motion.joined);
  if (pairs.empty()) return motion;
  return checked(std::move(motion),
                 std::make_shared<const Joined_pairs>(Joined_pairs{std::move(pairs), mesh.string()}));
}

}  // namespace lodestone
