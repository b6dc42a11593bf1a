// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/entrant.h"
#include "shared/lap_timer.h"
#include "shared/read_bound.h"

namespace lodestone {

namespace {

class Read_bound_entrant : public Entrant {
 public:
  explicit Read_bound_entrant(std::span<const Moving_mesh> meshes)
      : meshes_(meshes.begin(), meshes.end()), boxes_(meshes.size()) {}

  const Answer& play(std::span<const Object_pair> /*pairs*/) override {
    Lap_timer timer;
    for (std::size_t object = 0; object < meshes_.size(); ++object)
      boxes_[object] = read_every_vertex(meshes_[object].coordinates());
    answer_.update_seconds = timer.lap();
    return answer_;
  }

 private:
  std::vector<Moving_mesh> meshes_;
  std::vector<Box> boxes_;
  Answer answer_;
};

}  // namespace

Entry read_bound_entry() {
  return {.library = "bound",
          .method = "read every vertex once",
          .volume = "none",
          .answers = false,
          .reports_pairs = false,
          .build = [](std::span<const Moving_mesh> meshes) -> std::unique_ptr<Entrant> {
            return std::make_unique<Read_bound_entrant>(meshes);
          }};
}

}  // namespace lodestone
