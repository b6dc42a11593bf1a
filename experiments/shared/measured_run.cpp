// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/measured_run.h"

#include <algorithm>
#include <optional>

#include "lodestone/detector.h"
#include "lodestone/queries/exhaustive.h"
#include "shared/lap_timer.h"

namespace lodestone {

namespace {

using Scene_detector = Detector<Any_strategy>;

std::vector<Object_pair> all_pairs(const Scene& scene) {
  std::vector<Object_pair> pairs;
  for (std::uint32_t b = 0; b < scene.objects.size(); ++b)
    for (std::uint32_t a = 0; a < b; ++a)
      if (!scene.ignores({a, b})) pairs.push_back({a, b});
  return pairs;
}

Scene_detector make_detector(const Scene& scene, const Setting& setting) {
  Detector_options asked = setting.options;
  asked.contacts = Contact_query::yes_no;
  Scene_detector detector(asked, setting.strategy);
  for (const auto& object : scene.objects) {
    Object_options options{.particles = setting.options.particles > 0 ? 0 : object.particles,
                           .groups = object.collision.groups,
                           .meets = object.collision.meets};
    if (const auto& side = object.scattered_side) options.scattered_side = coordinates(*side);
    detector.add(std::as_const(object.mesh), options);
  }
  for (const auto& pair : scene.ignored) detector.ignore(pair.a, pair.b);
  return detector;
}

bool answered(const Frame& frame, Object_pair pair) {
  return std::ranges::any_of(
      frame.pairs, [&](const auto& found) { return found.a == pair.a && found.b == pair.b && found.collides; });
}

/// One scene, all settings.
class Scene_run {
 public:
  Scene_run(Scene& scene, std::span<const Setting> settings, Truth_source truth)
      : scene_(scene), pairs_(all_pairs(scene)) {
    if (truth == Truth_source::exact_mode)
      exact_.emplace(make_detector(scene, {.name = "truth", .options = {.mode = Mode::exact}}));
    for (const auto& setting : settings) detectors_.push_back(make_detector(scene, setting));
    scores_.resize(settings.size());
  }

  void play(std::size_t frame, Measured_run& run) {
    for (auto& object : scene_.objects) pose(object, frame);
    const auto truth = find_truth(frame > 0 ? &run.exhaustive_seconds : nullptr);
    for (std::size_t turn = 0; turn < detectors_.size(); ++turn) {
      // Each frame starts with another setting, because the first one finds the positions outside the caches.
      const std::size_t s = (frame + turn) % detectors_.size();
      detectors_[s].update();
      const Frame& answer = detectors_[s].detect();
      run.measurements[s].build_seconds += answer.statistics.seconds.build;
      if (frame > 0) run.measurements[s].frames.push_back(answer.statistics);
      for (std::size_t p = 0; p < pairs_.size(); ++p) scores_[s].add(pairs_[p], truth[p], answered(answer, pairs_[p]));
    }
  }

  void finish(Measured_run& run) {
    for (std::size_t s = 0; s < detectors_.size(); ++s) {
      scores_[s].finish();
      run.measurements[s].score.add(scores_[s]);
      run.measurements[s].accuracies.push_back(scores_[s].accuracy());
      run.measurements[s].particles.clear();
      if (run.measurements[s].setting.options.mode == Mode::exact) continue;
      for (Object_id o = 0; o < detectors_[s].size(); ++o)
        run.measurements[s].particles.push_back(detectors_[s].object(o).particles().at.size());
    }
  }

 private:
  std::vector<bool> find_truth(std::vector<double>* seconds) {
    std::vector<bool> truth;
    const Lap_timer timer;
    if (exact_) {
      const Frame& answer = exact_->detect();
      for (const auto pair : pairs_) truth.push_back(answered(answer, pair));
    } else {
      for (const auto& [a, b] : pairs_)
        truth.push_back(!exhaustive_face_pairs(scene_.objects[a].mesh, scene_.objects[b].mesh).empty());
    }
    if (seconds != nullptr) seconds->push_back(timer.seconds());
    return truth;
  }

  Scene& scene_;
  std::vector<Object_pair> pairs_;
  std::vector<Scene_detector> detectors_;
  std::vector<Score> scores_;
  std::optional<Scene_detector> exact_;
};

}  // namespace

Measured_run measure(std::span<Scene> scenes, std::span<const Setting> settings,
                     const std::function<void(std::size_t, std::size_t)>& progress, Truth_source truth) {
  Measured_run run;
  for (const auto& setting : settings) run.measurements.push_back({.setting = setting});
  std::size_t frames = 0;
  for (const auto& scene : scenes) frames += scene.frames;
  std::size_t done = 0;
  for (auto& scene : scenes) {
    Scene_run scene_run(scene, settings, truth);
    for (std::size_t frame = 0; frame < scene.frames; ++frame) {
      scene_run.play(frame, run);
      progress(++done, frames);
    }
    scene_run.finish(run);
  }
  return run;
}

}  // namespace lodestone
