// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/scene_detector.h"

#include <algorithm>

namespace lodestone {

bool makes_regions(const Detector_options& options, const Scene& scene) {
  const auto asks = [](const auto& object) { return object.particles > 0; };
  return options.mode == Mode::particles ||
         (finds_all(options.mode) && (options.particles > 0 || std::ranges::any_of(scene.objects, asks)));
}

}  // namespace lodestone
