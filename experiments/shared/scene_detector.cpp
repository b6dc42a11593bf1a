// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/scene_detector.h"

#include "lodestone/io/scenes/object_options.h"

namespace lodestone {

Detector<Any_strategy> scene_detector(const Scene& scene, const Setting& setting, Contact_query contacts) {
  Detector_options asked = setting.options;
  asked.contacts = contacts;
  Detector<Any_strategy> detector(asked, setting.strategy);
  for (const auto& object : scene.objects) {
    Object_options options = object_options(object);
    if (setting.options.particles > 0) options.particles = 0;
    detector.add(object.mesh, options);
  }
  for (const auto& pair : scene.ignored) detector.ignore(pair.a, pair.b);
  return detector;
}

std::vector<Object_pair> object_pairs(const Scene& scene) {
  std::vector<Object_pair> pairs;
  for (std::uint32_t a = 0; a < scene.objects.size(); ++a)
    for (std::uint32_t b = a + 1; b < scene.objects.size(); ++b)
      if (!scene.ignores({a, b})) pairs.push_back({a, b});
  return pairs;
}

}  // namespace lodestone
