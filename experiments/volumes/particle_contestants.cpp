// SPDX-License-Identifier: GPL-3.0-or-later
// The method of the paper on the frames of a race. It reads a few vertices and may miss collisions.
#include <fmt/format.h>

#include <utility>

#include "lodestone/detector.h"
#include "shared/lap_timer.h"
#include "volumes/contestants.h"

namespace lodestone {

namespace {

class Particle_entrant : public Entrant {
 public:
  Particle_entrant(std::span<const Moving_mesh> meshes, std::size_t particles,
                   std::shared_ptr<Particle_figures> figures)
      : detector_({.mode = Mode::particles,
                   .particles = particles,
                   .meetings = 0,
                   .contacts = Contact_query::yes_no,
                   .growth = 1.25}),
        figures_(std::move(figures)) {
    for (const auto& mesh : meshes) detector_.add(*mesh.mesh);
    detector_.detect();  // the first frame partitions the surfaces
  }

  /// Particles walk on from the frame before, so they play all frames of the scene in order. At the start of a pass
  /// they jump from the last frame back to the first; that frame does not count.
  bool wants_approach() const override { return true; }
  void start_round(std::size_t /*round*/) override { jumps_ = true; }
  void approach() override {
    Lap_timer timer;
    detector_.update();
    const Frame& frame = detector_.detect();
    count(timer.lap(), frame);
  }

  const Answer& play(std::span<const Object_pair> pairs) override {
    answer_.collides.assign(pairs.size(), false);
    Lap_timer timer;
    detector_.update();
    answer_.update_seconds = timer.lap();
    const Frame& frame = detector_.detect();
    answer_.any_seconds = timer.lap();
    count(answer_.update_seconds + answer_.any_seconds, frame);
    for (const auto& found : frame.pairs)
      if (const auto index = index_of({found.a, found.b}, pairs); index < pairs.size())
        answer_.collides[index] = found.collides;
    return answer_;
  }

 private:
  void count(double seconds, const Frame& frame) {
    if (std::exchange(jumps_, false)) return;
    ++figures_->frames;
    figures_->seconds += seconds;
    figures_->repartitions += frame.statistics.repartitions;
  }

  Detector<> detector_;
  std::shared_ptr<Particle_figures> figures_;
  Answer answer_;
  bool jumps_ = false;
};

}  // namespace

Contestant particle_contestant(std::size_t particles) {
  const std::string model = fmt::format("particles, {}", particles);
  const auto figures = std::make_shared<Particle_figures>();
  return {.kind = Contestant_kind::particles,
          .model = model,
          .strategy = "lbg",
          .entry = {.library = "Lodestone",
                    .method = model,
                    .volume = "none",
                    .reports_pairs = false,
                    .build = [=](std::span<const Moving_mesh> meshes) -> std::unique_ptr<Entrant> {
                      return std::make_unique<Particle_entrant>(meshes, particles, figures);
                    }},
          .particles = figures};
}

std::vector<Contestant> all_contestants(const std::vector<std::shared_ptr<Scene_division>>& divisions) {
  std::vector<Contestant> all{
      {.kind = Contestant_kind::bound, .model = "bound", .strategy = "", .entry = read_bound_entry()}};
  for (auto& contestant : volume_contestants(divisions)) all.push_back(std::move(contestant));
  for (const std::size_t particles : {12, 32, 64}) all.push_back(particle_contestant(particles));
  return all;
}

}  // namespace lodestone
