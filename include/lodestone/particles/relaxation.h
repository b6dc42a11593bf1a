// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "lodestone/mesh/errors.h"
#include "lodestone/particles/interaction.h"
#include "lodestone/particles/region_steps.h"

namespace lodestone {

/// Reads the current position of a vertex by its index.
template <class Reader>
concept Position_reader = requires(const Reader& reader, std::uint32_t vertex) {
  { reader(vertex) } -> std::convertible_to<Eigen::Vector3d>;
};

/// The particles of one object, kept from frame to frame.
struct Particles {
  std::vector<std::uint32_t> at;           ///< N: the vertex on which each particle is
  std::vector<Eigen::Vector3d> positions;  ///< N: the position of that vertex in this frame
  double effective_radius = 0;             ///< R_eff: how far a force is felt
  double collision_distance = 0;           ///< mu
  std::size_t hop_limit = 0;               ///< R_max: largest hop distance between two particles
};

/// One object as relaxation sees it.
template <Position_reader Reader>
struct Walking_object {
  Particles* particles = nullptr;
  const Region_steps* steps = nullptr;
  const Reader* reader = nullptr;
  std::span<const std::uint32_t> opponents;  ///< indices of the objects whose particles this one feels
  bool siblings_repel = false;               ///< particles of the object push each other away: only for the predecessor
};

struct Relaxation {
  std::size_t iterations = 0;
  std::size_t moves = 0;  ///< steps taken by all particles together
  bool relaxed = true;    ///< false: R_max stopped the iterations
};

/// Working memory of the relaxation, kept so that a frame allocates nothing.
struct Relaxation_scratch {
  Attractors attractors;
  Attractors siblings;
  std::vector<std::vector<std::uint32_t>> next_at;
  std::vector<std::vector<Eigen::Vector3d>> next_positions;

  /// Makes room for objects with so many particles each.
  void reserve(std::span<const std::size_t> particles);
};

namespace internal {

/// The best step of one particle: to the vertex in reach with the largest force; ties go to the lowest index.
struct Step {
  std::uint32_t vertex = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

template <Position_reader Reader>
Step best_step(const Walking_object<Reader>& object, std::size_t particle, const Relaxation_scratch& scratch) {
  constexpr int lanes = Attractors::lanes;
  const std::uint32_t here = object.particles->at[particle];
  const auto reach = object.steps->from(here);
  Step best{.vertex = here, .position = object.particles->positions[particle]};
  double largest = -std::numeric_limits<double>::infinity();
  bool pulled = false;
  bool held = false;
  Eigen::Vector3d zero = Eigen::Vector3d::Zero();

  for (std::size_t first = 0; first < reach.size(); first += lanes) {
    const auto count = std::min<std::size_t>(lanes, reach.size() - first);
    std::array<double, lanes> x, y, z, force, push;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const Eigen::Vector3d p = lane < count ? Eigen::Vector3d((*object.reader)(reach[first + lane])) : best.position;
      x[lane] = p.x();
      y[lane] = p.y();
      z[lane] = p.z();
      zero += 0 * p;  // stays zero unless a coordinate is not finite
    }
    scratch.attractors.forces(x.data(), y.data(), z.data(), force.data());
    if (object.siblings_repel) {
      scratch.siblings.forces(x.data(), y.data(), z.data(), push.data(), static_cast<std::ptrdiff_t>(particle));
      for (int lane = 0; lane < lanes; ++lane) force[lane] -= push[lane];
    }
    for (std::size_t lane = 0; lane < count; ++lane) {
      pulled |= force[lane] != 0;
      held |= reach[first + lane] == here && force[lane] == std::numeric_limits<double>::infinity();
      if (force[lane] > largest) {
        largest = force[lane];
        best = {.vertex = reach[first + lane], .position = {x[lane], y[lane], z[lane]}};
      }
    }
  }
  if (!zero.isZero(0))
    throw Bad_mesh("a vertex beside vertex " + std::to_string(here) + " has a coordinate that is not finite");
  // A particle that feels no force stays, and so does one that is at r = 0, because it has arrived.
  if (!pulled || held) return {.vertex = here, .position = object.particles->positions[particle]};
  return best;
}

template <Position_reader Reader>
void gather_attractors(std::span<const Walking_object<Reader>> objects, const Walking_object<Reader>& object,
                       Relaxation_scratch& scratch) {
  const auto add_all = [](Attractors& attractors, const Particles& particles, double reach) {
    for (const auto& position : particles.positions) attractors.add(position, reach * reach);
  };
  scratch.attractors.clear();
  for (const auto other : object.opponents) {
    const Particles& particles = *objects[other].particles;
    add_all(scratch.attractors, particles, std::max(object.particles->effective_radius, particles.effective_radius));
  }
  if (!object.siblings_repel) return;
  scratch.siblings.clear();
  add_all(scratch.siblings, *object.particles, object.particles->effective_radius);
}

}  // namespace internal

/// Lets particles walk until they rest: the particle stage of \cite saenghaengtham2006.
///
/// In every iteration each particle compares its vertex and the neighbours in its own region, and moves to the one
/// where the force is largest. The force is the sum of 1 / r^2 over the particles of near objects at r < R_eff, eq.
/// (10) to (12); R_eff is the larger of the two objects'. All particles read the positions from before the iteration.
/// Ties go to the lowest vertex index. A particle stays if it feels no force, or if it is at r = 0. The particles are
/// relaxed when fewer than R_min = N / 10 moved in each object; the paper has R_min "about ten times smaller than" N.
/// R_max, the largest of all objects', limits the iterations; see `hop_diameter`.
///
/// Cost per iteration O(d N N') for N particles that have d vertices in reach and feel N' others. Reads positions only
/// of vertices in reach of a particle. Allocates nothing once the scratch has its size.
///
/// @throws Bad_mesh  a coordinate that is read is not finite
/// @param objects  the `positions` of their particles must be those of this frame; `at` and `positions` are updated
template <Position_reader Reader>
Relaxation relax(std::span<const Walking_object<Reader>> objects, Relaxation_scratch& scratch) {
  Relaxation result;
  std::size_t iteration_limit = 1;
  for (const auto& object : objects)
    if (!object.opponents.empty()) iteration_limit = std::max(iteration_limit, object.particles->hop_limit);

  for (result.relaxed = false; !result.relaxed && result.iterations < iteration_limit; ++result.iterations) {
    result.relaxed = true;
    for (std::size_t o = 0; o < objects.size(); ++o) {
      if (objects[o].opponents.empty()) continue;
      const std::size_t count = objects[o].particles->at.size();
      internal::gather_attractors(objects, objects[o], scratch);
      std::size_t moved = 0;
      for (std::size_t p = 0; p < count; ++p) {
        const auto step = internal::best_step(objects[o], p, scratch);
        moved += step.vertex != objects[o].particles->at[p] ? 1 : 0;
        scratch.next_at[o][p] = step.vertex;
        scratch.next_positions[o][p] = step.position;
      }
      result.moves += moved;
      result.relaxed &= 10 * moved < count;
    }
    for (std::size_t o = 0; o < objects.size(); ++o) {
      if (objects[o].opponents.empty()) continue;
      objects[o].particles->at.swap(scratch.next_at[o]);
      objects[o].particles->positions.swap(scratch.next_positions[o]);
    }
  }
  return result;
}

}  // namespace lodestone
