// SPDX-License-Identifier: GPL-3.0-or-later
// The method of the paper on the frames of a race: it reads a few vertices, and may miss.
#include <fmt/format.h>

#include <algorithm>

#include "contestants.h"
#include "lap_timer.h"
#include "lodestone/detector.h"

namespace lodestone {

namespace {

class Particle_entrant : public Entrant {
 public:
  Particle_entrant(std::span<const Moving_mesh> meshes, std::size_t particles)
      : detector_({.particles = particles, .contacts = Contact_query::yes_no, .growth = 1.25}) {
    for (const auto& mesh : meshes) detector_.add(*mesh.mesh);
    detector_.detect();  // divides the surfaces
  }

  /// Particles walk from where they were in the frame before. They cannot jump to a sampled frame.
  bool wants_approach() const override { return true; }
  void approach() override {
    detector_.update();
    detector_.detect();
  }

  const Answer& play(std::span<const Object_pair> pairs) override {
    answer_.collides.assign(pairs.size(), false);
    Lap_timer timer;
    detector_.update();
    answer_.update_seconds = timer.lap();
    const Frame& frame = detector_.detect();
    answer_.any_seconds = timer.lap();
    for (const auto& found : frame.pairs) {
      const auto place = std::ranges::find(pairs, Object_pair{found.a, found.b}) - pairs.begin();
      if (place < std::ssize(pairs)) answer_.collides[static_cast<std::size_t>(place)] = found.collides;
    }
    return answer_;
  }

 private:
  Detector<Surface_mesh> detector_;
  Answer answer_;
};

}  // namespace

Contestant particle_contestant(std::size_t particles) {
  const std::string model = fmt::format("particles, {}", particles);
  return {.kind = Contestant_kind::particles,
          .model = model,
          .strategy = "lbg",
          .entry = {.library = "Lodestone",
                    .method = model,
                    .volume = "none",
                    .reports_pairs = false,
                    .build = [particles](std::span<const Moving_mesh> meshes) -> std::unique_ptr<Entrant> {
                      return std::make_unique<Particle_entrant>(meshes, particles);
                    }},
          .figures = nullptr};
}

std::vector<Contestant> all_contestants(const std::vector<std::shared_ptr<Scene_division>>& divisions) {
  std::vector<Contestant> all{{.kind = Contestant_kind::bound,
                               .model = "bound",
                               .strategy = "",
                               .entry = read_bound_entry(),
                               .figures = nullptr}};
  for (auto& contestant : volume_contestants(divisions)) all.push_back(std::move(contestant));
  for (const std::size_t particles : {12, 32, 64}) all.push_back(particle_contestant(particles));
  return all;
}

}  // namespace lodestone
