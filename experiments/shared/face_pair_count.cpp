// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/face_pair_count.h"

#include <algorithm>
#include <iterator>

#include "shared/scene_detector.h"

namespace lodestone {

namespace {

/// How many face pairs of a true object pair the answer lists too.
std::size_t found_face_pairs(const Frame& truth, const Pair_result& pair, const Frame& answer) {
  const auto listed =
      std::ranges::find_if(answer.pairs, [&](const auto& other) { return other.a == pair.a && other.b == pair.b; });
  if (listed == answer.pairs.end()) return 0;
  std::vector<Face_pair> common;
  std::ranges::set_intersection(truth.contacts(pair), answer.contacts(*listed), std::back_inserter(common));
  return common.size();
}

}  // namespace

std::vector<Face_pair_count> count_face_pairs(Scene& scene, std::span<const Setting> settings,
                                              const std::function<void(std::size_t, std::size_t)>& progress) {
  auto exact = scene_detector(scene, {.name = "truth", .options = {.mode = Mode::exact}}, Contact_query::all);
  std::vector<Detector<Any_strategy>> detectors;
  for (const auto& setting : settings) detectors.push_back(scene_detector(scene, setting, Contact_query::all));
  std::vector<Face_pair_count> counts(settings.size());
  for (std::size_t frame = 0; frame < scene.frames; ++frame) {
    for (auto& object : scene.objects) pose(object, frame);
    const Frame& truth = exact.detect();
    for (std::size_t s = 0; s < detectors.size(); ++s) {
      detectors[s].update();
      const Frame& answer = detectors[s].detect();
      for (const auto& pair : truth.pairs) counts[s].found += found_face_pairs(truth, pair, answer);
      counts[s].all += truth.face_pairs.size();
    }
    progress(frame + 1, scene.frames);
  }
  return counts;
}

}  // namespace lodestone
