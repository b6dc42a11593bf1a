// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "shared/entrant.h"
#include "volumes/scene_division.h"
#include "volumes/tightness.h"

/// The contestants of the experiment `volumes`.
namespace lodestone {

/// Figures of a tree that the race itself does not measure.
struct Volume_figures {
  std::size_t node_bytes = 0;  ///< of a volume
  std::size_t nodes = 0;       ///< of all objects
  std::size_t frames = 0;      ///< the counts below are sums over these
  std::size_t volume_tests = 0;
  std::size_t leaf_pairs = 0;
  std::size_t exact_tests = 0;
  Tightness first = {}, last = {};  ///< in the first and in the last sampled frame

  double per_frame(std::size_t Volume_figures::*count) const {
    return frames > 0 ? static_cast<double>(this->*count) / static_cast<double>(frames) : 0;
  }
};

/// Figures of particles over all frames that they played, sampled or not.
struct Particle_figures {
  std::size_t frames = 0;
  double seconds = 0;            ///< of updates and queries
  std::size_t repartitions = 0;  ///< of objects

  double mean_seconds() const { return frames > 0 ? seconds / static_cast<double>(frames) : 0; }
};

enum class Contestant_kind { bound, volume, particles };

/// A row of the tables.
struct Contestant {
  Contestant_kind kind;
  std::string model;     ///< the volume; `particles, 12`; `bound`
  std::string strategy;  ///< empty: none
  Entry entry;
  std::shared_ptr<const Volume_figures> figures = nullptr;      ///< of volumes; the race fills them
  std::shared_ptr<const Particle_figures> particles = nullptr;  ///< of particles; the race fills them
};

/// A tree of each model of Bounding_volume over each division.
std::vector<Contestant> volume_contestants(const std::vector<std::shared_ptr<Scene_division>>& divisions);
/// The mode `particles`.
/// @param particles  per object
Contestant particle_contestant(std::size_t particles);
/// The bound, all volumes, and the particles of the paper.
std::vector<Contestant> all_contestants(const std::vector<std::shared_ptr<Scene_division>>& divisions);

}  // namespace lodestone
