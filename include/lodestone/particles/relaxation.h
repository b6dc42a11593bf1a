// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/workers.h"
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

/// One particle that feels another.
struct Pull {
  std::uint32_t particle = 0;                     ///< of the object that feels
  std::uint32_t object = 0;                       ///< whose particle is felt
  std::uint32_t by = 0;                           ///< that particle
  auto operator<=>(const Pull&) const = default;  ///< by particle, then by what it feels
};

/// One object as relaxation sees it.
template <Position_reader Reader>
struct Walking_object {
  Particles* particles = nullptr;            ///< those that walk; moved by `relax`
  const Region_steps* steps = nullptr;       ///< where they can step
  const Reader* reader = nullptr;            ///< where vertices are in this frame
  bool shared_reader = false;                ///< several threads may call the reader at once
  std::span<const std::uint32_t> opponents;  ///< indices of the objects whose particles this one feels
  bool siblings_repel = false;               ///< particles of the object push each other away: only for the predecessor
  /// Which particles feel which, in ascending order; then forces have no limit of distance. None: all particles of the
  /// object feel all of the opponents', within R_eff.
  std::optional<std::span<const Pull>> pulls = {};
};

/// What `relax` has done.
struct Relaxation {
  std::size_t iterations = 0;     ///< each is over all objects
  std::size_t moves = 0;          ///< steps taken by all particles together
  bool relaxed = true;            ///< false: R_max stopped the iterations
  std::size_t vertices_read = 0;  ///< positions read, some more than once
};

/// What is known of a particle at rest: it stayed when its steps were last compared. The comparison need not be made
/// again before an attractor moves whose force reaches one of these steps.
struct Rest {
  bool stayed = false;      ///< false: it moved, or nothing is known
  double step_length = -1;  ///< from the particle to the farthest vertex in reach of a step; negative: not measured
};

/// The particles of an object that moved in an iteration.
struct Moved_particles {
  std::vector<std::uint32_t> which;         ///< ascending
  std::vector<std::uint32_t> from;          ///< parallel to `which`: the vertex on which each was
  std::vector<Eigen::Vector3d> from_there;  ///< its position

  /// Makes room for so many.
  void reserve(std::size_t count) { which.reserve(count), from.reserve(count), from_there.reserve(count); }
  /// Leaves none; the memory is kept.
  void clear() { which.clear(), from.clear(), from_there.clear(); }
};

/// Working memory of the relaxation, kept so that a frame allocates nothing.
struct Relaxation_scratch {
  Attractors attractors;                            ///< what the particles of the current object feel
  Attractors siblings;                              ///< the particles of the object itself, where these repel
  std::vector<std::vector<std::uint32_t>> next_at;  ///< per object and particle: the vertex after this iteration
  std::vector<std::vector<Eigen::Vector3d>> next_positions;  ///< of these vertices
  std::vector<std::vector<Rest>> rests;                      ///< per object and particle
  std::vector<Moved_particles> moved;                        ///< per object: in the last iteration
  std::vector<Moved_particles> moved_before;                 ///< in the one before
  std::vector<std::uint32_t> awake;     ///< the particles of the current object that compare their steps, ascending
  std::vector<std::size_t> iterations;  ///< per object: in which one of its particles was evaluated
  std::size_t vertices_read = 0;        ///< since `start`

  /// Makes room for objects with so many particles each.
  void reserve(std::span<const std::size_t> particles);
  /// Forgets who rested and who moved in the last frame.
  void start();
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
      for (std::size_t lane = 0; lane < lanes; ++lane) force[lane] -= push[lane];
    }
    for (std::size_t lane = 0; lane < count; ++lane) {
      pulled |= force[lane] != 0;
      // Not `== infinity`: where a sibling is in the same place too, the force is infinity - infinity, which is NaN.
      held |= reach[first + lane] == here && !(force[lane] < std::numeric_limits<double>::infinity());
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

/// From a particle to the farthest vertex in reach of a step.
template <Position_reader Reader>
double measure_step_length(const Walking_object<Reader>& object, std::size_t particle) {
  double squared = 0;
  for (const auto vertex : object.steps->from(object.particles->at[particle]))
    squared = std::max(squared, ((*object.reader)(vertex)-object.particles->positions[particle]).squaredNorm());
  return std::sqrt(squared);
}

/// Whether the force of a particle that has moved reaches a step of one at rest, from where it was or where it is.
inline bool disturbs(const Moved_particles& moved, const Particles& movers, double reach,
                     const Eigen::Vector3d& position, const Rest& rest) {
  constexpr double rounding = 1 + 1e-9;
  const double near = rounding * (reach + rest.step_length), squared = near * near;
  // Not `<=`: what is not a number disturbs.
  const auto is_near = [&](const Eigen::Vector3d& attractor) {
    return !((attractor - position).squaredNorm() > squared);
  };
  for (std::size_t i = 0; i < moved.which.size(); ++i)
    if (is_near(moved.from_there[i]) || is_near(movers.positions[moved.which[i]])) return true;
  return false;
}

/// The number of particles that can walk: all, or those that are pulled.
template <Position_reader Reader>
std::size_t count_walkers(const Walking_object<Reader>& object) {
  if (!object.pulls) return object.particles->at.size();
  const auto pulls = *object.pulls;
  std::size_t count = 0;
  for (std::size_t i = 0; i < pulls.size(); ++i) count += i == 0 || pulls[i].particle != pulls[i - 1].particle ? 1 : 0;
  return count;
}

/// Counts the positions that a particle reads to choose its step.
template <Position_reader Reader>
void count_reads(const Walking_object<Reader>& object, std::size_t particle, Relaxation_scratch& scratch) {
  scratch.vertices_read += object.steps->from(object.particles->at[particle]).size();
}

/// Whether a particle stays without another comparison of its steps.
template <Position_reader Reader>
bool rests(std::span<const Walking_object<Reader>> objects, std::size_t o, std::size_t particle,
           Relaxation_scratch& scratch) {
  Rest& rest = scratch.rests[o][particle];
  if (!rest.stayed) return false;
  const Particles& particles = *objects[o].particles;
  const auto disturbed_by = [&](std::size_t other) {
    if (scratch.moved[other].which.empty()) return false;
    if (rest.step_length < 0) {
      rest.step_length = measure_step_length(objects[o], particle);
      count_reads(objects[o], particle, scratch);
    }
    const Particles& movers = *objects[other].particles;
    return disturbs(scratch.moved[other], movers, std::max(particles.effective_radius, movers.effective_radius),
                    particles.positions[particle], rest);
  };
  if (std::ranges::any_of(objects[o].opponents, disturbed_by)) return false;
  return !objects[o].siblings_repel || !disturbed_by(o);
}

/// Chooses the next step of a particle, given its attractors. Several threads may do so for different particles.
template <Position_reader Reader>
void choose_step(std::span<const Walking_object<Reader>> objects, std::size_t o, std::size_t p,
                 Relaxation_scratch& scratch) {
  const Step step = best_step(objects[o], p, scratch);
  scratch.rests[o][p] = {.stayed = step.vertex == objects[o].particles->at[p]};
  scratch.next_at[o][p] = step.vertex;
  scratch.next_positions[o][p] = step.position;
}

/// Whether a particle that is pulled stays without another comparison of its steps: nothing that it feels has moved.
inline bool rests(std::span<const Pull> pulls, const Rest& rest, const Relaxation_scratch& scratch) {
  return rest.stayed && std::ranges::none_of(pulls, [&](const Pull& pull) {
           return std::ranges::binary_search(scratch.moved[pull.object].which, pull.by);
         });
}

/// Chooses the next steps of the particles of an object that are pulled.
/// @return number of particles that will move
template <Position_reader Reader>
std::size_t choose_pulled_steps(std::span<const Walking_object<Reader>> objects, std::size_t o,
                                Relaxation_scratch& scratch) {
  constexpr double no_limit = std::numeric_limits<double>::infinity();
  const auto pulls = *objects[o].pulls;
  std::size_t moving = 0;
  for (std::size_t first = 0, end = 0; first < pulls.size(); first = end) {
    const std::uint32_t p = pulls[first].particle;
    while (end < pulls.size() && pulls[end].particle == p) ++end;
    const auto felt = pulls.subspan(first, end - first);
    if (rests(felt, scratch.rests[o][p], scratch)) continue;
    scratch.attractors.clear();
    for (const Pull& pull : felt) scratch.attractors.add(objects[pull.object].particles->positions[pull.by], no_limit);
    count_reads(objects[o], p, scratch);
    choose_step(objects, o, p, scratch);
    moving += scratch.rests[o][p].stayed ? 0 : 1;
  }
  return moving;
}

/// Lists the particles of an object that are not at rest.
template <Position_reader Reader>
void list_awake(std::span<const Walking_object<Reader>> objects, std::size_t o, Relaxation_scratch& scratch) {
  scratch.awake.clear();
  for (std::uint32_t p = 0; p < objects[o].particles->at.size(); ++p)
    if (!rests(objects, o, p, scratch)) scratch.awake.push_back(p);
}

/// Chooses the next steps of the particles that are awake, given their attractors.
template <Position_reader Reader>
void choose_awake_steps(std::span<const Walking_object<Reader>> objects, std::size_t o, Relaxation_scratch& scratch,
                        Workers& workers) {
  // A task takes some tens of microseconds: pairs of a particle and an attractor cost some 10 nanoseconds each.
  constexpr std::size_t pairs_per_task = 4096;
  const auto& awake = scratch.awake;
  const std::size_t per_task = pairs_per_task / std::min(pairs_per_task, scratch.attractors.size() + 1) + 1;
  const auto choose_some = [&](std::size_t task, std::size_t) {
    const std::size_t end = std::min(awake.size(), (task + 1) * per_task);
    for (std::size_t i = task * per_task; i < end; ++i) choose_step(objects, o, awake[i], scratch);
  };
  Workers& those = objects[o].shared_reader ? workers : Workers::alone();
  those.run((awake.size() + per_task - 1) / per_task, std::cref(choose_some));
}

/// Chooses the next step of each particle of an object.
/// @return number of particles that will move
template <Position_reader Reader>
std::size_t choose_steps(std::span<const Walking_object<Reader>> objects, std::size_t o, Relaxation_scratch& scratch,
                         Workers& workers = Workers::alone()) {
  const Particles& particles = *objects[o].particles;
  std::ranges::copy(particles.at, scratch.next_at[o].begin());
  std::ranges::copy(particles.positions, scratch.next_positions[o].begin());
  if (objects[o].pulls) return choose_pulled_steps(objects, o, scratch);
  list_awake(objects, o, scratch);
  if (scratch.awake.empty()) return 0;
  gather_attractors(objects, objects[o], scratch);
  for (const auto p : scratch.awake) count_reads(objects[o], p, scratch);
  choose_awake_steps(objects, o, scratch, workers);
  return static_cast<std::size_t>(
      std::ranges::count_if(scratch.awake, [&](std::uint32_t p) { return !scratch.rests[o][p].stayed; }));
}

/// Takes the steps, and notes who moved.
inline void take_steps(Particles& particles, std::size_t o, Relaxation_scratch& scratch) {
  Moved_particles& moved = scratch.moved[o];
  std::swap(moved, scratch.moved_before[o]);
  moved.clear();
  for (std::uint32_t p = 0; p < particles.at.size(); ++p) {
    if (scratch.next_at[o][p] == particles.at[p]) continue;
    moved.which.push_back(p);
    moved.from.push_back(particles.at[p]);
    moved.from_there.push_back(particles.positions[p]);
  }
  particles.at.swap(scratch.next_at[o]);
  particles.positions.swap(scratch.next_positions[o]);
}

/// Whether the last two iterations have led an object's particles back to where they were.
inline bool has_swung_back(const Particles& particles, std::size_t o, const Relaxation_scratch& scratch) {
  const Moved_particles &there = scratch.moved_before[o], &back = scratch.moved[o];
  if (there.which != back.which) return false;
  for (std::size_t i = 0; i < back.which.size(); ++i)
    if (particles.at[back.which[i]] != there.from[i]) return false;
  return true;
}

/// An iteration depends only on where the particles are. Once two iterations lead back to where they began, all others
/// do nothing but repeat them. So only whether their number is odd matters.
template <Position_reader Reader>
void swing_to_the_end(std::span<const Walking_object<Reader>> objects, std::size_t iteration_limit, Relaxation& result,
                      Relaxation_scratch& scratch) {
  const std::size_t left = iteration_limit - result.iterations;
  result.iterations = iteration_limit;
  for (std::size_t o = 0; o < objects.size(); ++o) {
    if (objects[o].opponents.empty()) continue;
    result.moves += left * scratch.moved[o].which.size();
    if (left % 2 == 0) continue;
    objects[o].particles->at.swap(scratch.next_at[o]);
    objects[o].particles->positions.swap(scratch.next_positions[o]);
  }
}

/// Sizes the scratch for these objects, if it is not. An object without particles has none that walk.
template <Position_reader Reader>
void fit(Relaxation_scratch& scratch, std::span<const Walking_object<Reader>> objects) {
  const auto count = [](const auto& object) { return object.particles != nullptr ? object.particles->at.size() : 0; };
  const auto fits = [&](const auto& object, const auto& rests) { return rests.size() == count(object); };
  if (std::ranges::equal(objects, scratch.rests, fits)) return;
  std::vector<std::size_t> counts;
  for (const auto& object : objects) counts.push_back(count(object));
  scratch.reserve(counts);
}

}  // namespace internal

/// Lets particles walk until they rest: the particle stage of \cite saenghaengtham2006.
///
/// In every iteration each particle compares its vertex and the neighbours in its own region, and moves to the one
/// where the force is largest. The force is the sum of 1 / r^2 over the particles of near objects at r < R_eff, eq.
/// (10) to (12); R_eff is the larger of the two objects'. All particles read the positions from before the iteration.
/// Ties go to the lowest vertex index. A particle stays if it feels no force, or if it is at r = 0. The particles are
/// relaxed when fewer than R_min = N / 10 moved in each object, or none; the paper has R_min "about ten times smaller
/// than" N. If only some of the particles are pulled, N is the number of those: the others cannot move.
/// R_max, the largest of the objects that have opponents, limits the iterations; see `hop_diameter`.
///
/// Instead of all particles of near objects, a particle can feel those that `Walking_object::pulls` names.
///
/// A particle that stayed is left alone until the force of a particle that has moved reaches one of its steps: it would
/// stay again. Particles that swing between two vertices are not followed to the last iteration.
///
/// Cost of the first iteration O(d N N') for N particles that have d vertices in reach and feel N' others. A later
/// iteration costs that for the particles that moved or are disturbed, and O(N M) for the others, where M moved. Reads
/// positions only of vertices in reach of a particle. Allocates nothing once the scratch has its size.
///
/// To follow the particles step by step, set the `hop_limit` of all of them to 1, and call this again and again: they go
/// the same way.
///
/// @throws Bad_mesh  a coordinate that is read is not finite
/// @param objects  the `positions` of their particles must be those of this frame; `at` and `positions` are updated
/// @param workers  share the comparisons of an iteration where a reader may be shared; the result does not depend on
///                 their number
template <Position_reader Reader>
Relaxation relax(std::span<const Walking_object<Reader>> objects, Relaxation_scratch& scratch,
                 Workers& workers = Workers::alone()) {
  Relaxation result;
  std::size_t iteration_limit = 1;
  for (const auto& object : objects)
    if (!object.opponents.empty()) iteration_limit = std::max(iteration_limit, object.particles->hop_limit);

  internal::fit(scratch, objects);
  scratch.start();
  for (result.relaxed = false; !result.relaxed && result.iterations < iteration_limit; ++result.iterations) {
    result.relaxed = true;
    for (std::size_t o = 0; o < objects.size(); ++o) {
      if (objects[o].opponents.empty()) continue;
      const std::size_t read = scratch.vertices_read;
      const std::size_t moving = internal::choose_steps(objects, o, scratch, workers);
      if (scratch.vertices_read > read) ++scratch.iterations[o];
      result.moves += moving;
      result.relaxed &= moving == 0 || 10 * moving < internal::count_walkers(objects[o]);
    }
    bool swings = true;
    for (std::size_t o = 0; o < objects.size(); ++o) {
      if (objects[o].opponents.empty()) continue;
      internal::take_steps(*objects[o].particles, o, scratch);
      swings &= internal::has_swung_back(*objects[o].particles, o, scratch);
    }
    if (swings && !result.relaxed && result.iterations > 0) {
      ++result.iterations;
      internal::swing_to_the_end(objects, iteration_limit, result, scratch);
      break;
    }
  }
  result.vertices_read = scratch.vertices_read;
  return result;
}

}  // namespace lodestone
