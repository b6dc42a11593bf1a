// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/scene_detector.h"

#include <algorithm>

namespace lodestone {

bool makes_regions(const Detector_options& options, const Scene& scene) {
  const auto asks = [](const auto& object) { return object.particles > 0; };
  return options.mode == Mode::particles ||
         (finds_all(options.mode) && (options.particles > 0 || std::ranges::any_of(scene.objects, asks)));
}

Particle_setting particle_setting(const Detect_command& command, const Scene& scene) {
  Particle_setting setting{.strategy = command.partition.name, .lbg = command.partition.settings.lbg};
  if (command.chooses_particles) return setting;  // counts for every object
  for (const auto& object : scene.objects)
    if (object.particles > 0 && (setting.fewest_particles == 0 || object.particles < setting.fewest_particles))
      setting.fewest_particles = object.particles;
  return setting;
}

}  // namespace lodestone
