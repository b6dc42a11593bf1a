// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/relaxation.h"

#include <numeric>

namespace lodestone {

void Relaxation_scratch::reserve(std::span<const std::size_t> particles) {
  attractors.reserve(std::accumulate(particles.begin(), particles.end(), std::size_t{0}));
  siblings.reserve(particles.empty() ? 0 : *std::ranges::max_element(particles));
  awake.reserve(particles.empty() ? 0 : *std::ranges::max_element(particles));
  next_at.resize(particles.size());
  next_positions.resize(particles.size());
  rests.resize(particles.size());
  moved.resize(particles.size());
  moved_before.resize(particles.size());
  iterations.resize(particles.size());
  for (std::size_t object = 0; object < particles.size(); ++object) {
    next_at[object].resize(particles[object]);
    next_positions[object].resize(particles[object]);
    rests[object].resize(particles[object]);
    moved[object].reserve(particles[object]);
    moved_before[object].reserve(particles[object]);
  }
}

void Relaxation_scratch::start() {
  vertices_read = 0;
  std::ranges::fill(iterations, 0);
  for (auto& object : rests) std::ranges::fill(object, Rest{});
  for (auto* list : {&moved, &moved_before})
    for (auto& object : *list) object.clear();
}

}  // namespace lodestone
