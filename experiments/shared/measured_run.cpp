// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/measured_run.h"

#include <numeric>
#include <optional>

#include "lodestone/queries/exhaustive.h"
#include "shared/lap_timer.h"
#include "shared/scene_detector.h"

namespace lodestone {

namespace {

/// Whether each pair collides. Both lists are sorted by (a, b), so one pass is enough.
std::vector<bool> answers(const Frame& frame, std::span<const Object_pair> pairs) {
  std::vector<bool> collide;
  collide.reserve(pairs.size());
  auto found = frame.pairs.begin();
  const auto place = [&] { return Object_pair{found->a, found->b}; };
  for (const auto pair : pairs) {
    while (found != frame.pairs.end() && place() < pair) ++found;
    collide.push_back(found != frame.pairs.end() && place() == pair && found->collides);
  }
  return collide;
}

/// One play of one scene by all settings.
class Play {
 public:
  Play(Scene& scene, std::span<const Setting> settings, Truth_source truth)
      : scene_(scene), pairs_(object_pairs(scene)) {
    if (truth == Truth_source::exact_mode)
      exact_.emplace(scene_detector(scene, {.name = "truth", .options = {.mode = Mode::exact}}, Contact_query::yes_no));
    for (const auto& setting : settings) detectors_.push_back(scene_detector(scene, setting, Contact_query::yes_no));
    scores_.resize(settings.size());
  }

  /// Builds the objects in the pose of a frame. That answer is not scored.
  void build(std::size_t frame, Measured_run& run) {
    pose_all(frame);
    for (std::size_t s = 0; s < detectors_.size(); ++s)
      run.measurements[s].build_seconds += detectors_[s].detect().statistics.seconds.build;
  }

  void play(std::size_t frame, Measured_run& run) {
    pose_all(frame);
    const bool is_timed = frame > 0 || scene_.frames == 1;
    const auto truth = find_truth(is_timed ? &run.exhaustive_seconds : nullptr);
    for (const std::size_t s : order_of_turns(frame, detectors_.size())) {
      detectors_[s].update();
      const Frame& answer = detectors_[s].detect();
      run.measurements[s].build_seconds += answer.statistics.seconds.build;
      if (is_timed) run.measurements[s].frames.push_back(answer.statistics);
      const auto collide = answers(answer, pairs_);
      for (std::size_t p = 0; p < pairs_.size(); ++p) scores_[s].add(pairs_[p], truth[p], collide[p]);
    }
  }

  void finish(Measured_run& run) {
    for (std::size_t s = 0; s < detectors_.size(); ++s) {
      auto& measurement = run.measurements[s];
      scores_[s].finish();
      measurement.score.add(scores_[s]);
      measurement.accuracies.push_back(scores_[s].accuracy());
      measurement.recalls.push_back(scores_[s].recall());
      measurement.particles.clear();
      if (finds_all(measurement.setting.options.mode)) continue;
      for (Object_id o = 0; o < detectors_[s].size(); ++o)
        measurement.particles.push_back(detectors_[s].object(o).particles().at.size());
    }
  }

 private:
  void pose_all(std::size_t frame) {
    for (auto& object : scene_.objects) pose(object, frame);
  }

  std::vector<bool> find_truth(std::vector<double>* seconds) {
    std::vector<bool> truth;
    const Lap_timer timer;
    if (exact_) {
      truth = answers(exact_->detect(), pairs_);
    } else {
      for (const auto& [a, b] : pairs_)
        truth.push_back(!exhaustive_face_pairs(scene_.objects[a].mesh, scene_.objects[b].mesh).empty());
    }
    if (seconds != nullptr) seconds->push_back(timer.seconds());
    return truth;
  }

  Scene& scene_;
  std::vector<Object_pair> pairs_;
  std::vector<Detector<Any_strategy>> detectors_;
  std::vector<Score> scores_;
  std::optional<Detector<Any_strategy>> exact_;
};

}  // namespace

std::vector<std::size_t> order_of_turns(std::size_t frame, std::size_t settings) {
  std::vector<std::size_t> strides;  // that reach every setting
  for (std::size_t stride = 1; stride <= settings; ++stride)
    if (std::gcd(stride, settings) == 1) strides.push_back(stride);
  std::vector<std::size_t> order;
  for (std::size_t turn = 0; turn < settings; ++turn)
    order.push_back((frame + turn * strides[frame % strides.size()]) % settings);
  return order;
}

Measured_run measure(std::span<Scene> scenes, std::span<const Setting> settings,
                     const std::function<void(std::size_t, std::size_t)>& progress, const Measure_options& options) {
  Measured_run run;
  for (const auto& setting : settings) run.measurements.push_back({.setting = setting});
  std::size_t frames = 0;
  for (const auto& scene : scenes) frames += options.plays * scene.frames;
  std::size_t done = 0;
  for (auto& scene : scenes)
    for (std::size_t i = 0; i < options.plays; ++i) {
      Play play(scene, settings, options.truth);
      if (const std::size_t built_in = i * scene.frames / options.plays; built_in > 0) play.build(built_in, run);
      for (std::size_t frame = 0; frame < scene.frames; ++frame) {
        play.play(frame, run);
        progress(++done, frames);
      }
      play.finish(run);
    }
  return run;
}

}  // namespace lodestone
