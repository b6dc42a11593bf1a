// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/relaxation.h"

#include <numeric>

namespace lodestone {

void Relaxation_scratch::reserve(std::span<const std::size_t> particles) {
  attractors.reserve(std::accumulate(particles.begin(), particles.end(), std::size_t{0}));
  siblings.reserve(particles.empty() ? 0 : *std::ranges::max_element(particles));
  next_at.resize(particles.size());
  next_positions.resize(particles.size());
  for (std::size_t object = 0; object < particles.size(); ++object) {
    next_at[object].resize(particles[object]);
    next_positions[object].resize(particles[object]);
  }
}

}  // namespace lodestone
