// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scenes/shared_clock.h"

#include <set>

namespace lodestone {

void share_clock(std::span<Scene_object> objects) {
  constexpr double usual_rate = 30;
  std::set<double> rates, given, starts;
  for (const auto& object : objects) {
    if (object.motion.frames_per_second == 0) continue;
    rates.insert(object.motion.frames_per_second);
    starts.insert(object.motion.start);
    if (!object.motion.resampled) given.insert(object.motion.frames_per_second);
  }
  if (rates.size() < 2 && starts.size() < 2) return;
  const double common = given.size() == 1 ? *given.begin() : rates.size() == 1 ? *rates.begin() : usual_rate;
  for (auto& object : objects)
    if (object.motion.resampled) object.motion = object.motion.resampled(common);
}

}  // namespace lodestone
