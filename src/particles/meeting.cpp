// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/meeting.h"

#include <limits>
#include <string>

#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

/// One of two particles that meet.
struct Walker {
  const Walked_surface& surface;
  std::uint32_t at;
  Eigen::Vector3d position;

  Walker(const Walked_surface& s, std::uint32_t vertex) : surface(s), at(vertex), position(s.position(vertex)) {}
};

double checked(double squared_distance, std::uint32_t vertex) {
  if (squared_distance >= 0 && squared_distance <= std::numeric_limits<double>::max()) return squared_distance;
  throw Bad_mesh("vertex " + std::to_string(vertex) +
                 " or one near it has a coordinate that is not finite, or is beyond 1e150");
}

/// Takes one step if that leads nearer to the target.
/// @return whether it did
bool step_towards(const Eigen::Vector3d& target, Walker& walker, Ended_meeting& meeting) {
  const std::uint32_t from = walker.at;
  for (const std::uint32_t vertex : neighbours(*walker.surface.graph, from)) {
    const Eigen::Vector3d position = walker.surface.position(vertex);
    const double squared_distance = checked((position - target).squaredNorm(), vertex);
    ++meeting.vertices_read;
    if (squared_distance >= meeting.squared_distance) continue;
    meeting.squared_distance = squared_distance;
    walker.at = vertex;
    walker.position = position;
  }
  return walker.at != from;
}

}  // namespace

Ended_meeting meet(const Walked_surface& a, const Walked_surface& b, Meeting start, std::size_t most_hops) {
  Walker walker_a(a, start.a), walker_b(b, start.b);
  Ended_meeting meeting{.at = start, .vertices_read = 2};
  meeting.squared_distance = checked((walker_a.position - walker_b.position).squaredNorm(), start.a);
  for (bool nearer = true; nearer && meeting.hops < most_hops;) {
    nearer = false;
    for (; meeting.hops < most_hops && step_towards(walker_b.position, walker_a, meeting); nearer = true)
      ++meeting.hops;
    for (; meeting.hops < most_hops && step_towards(walker_a.position, walker_b, meeting); nearer = true)
      ++meeting.hops;
  }
  meeting.at = {walker_a.at, walker_b.at};
  return meeting;
}

}  // namespace lodestone
