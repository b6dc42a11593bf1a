// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/experiments.h"

#include <array>

namespace lodestone {

// Each in the folder of its name.
std::string run_teapot_sphere(const Experiment_context& context);
std::string run_certified(const Experiment_context& context);
std::string run_certified_soak(const Experiment_context& context);
std::string run_scaling(const Experiment_context& context);
std::string run_predecessor(const Experiment_context& context);
std::string run_collision_distance(const Experiment_context& context);
std::string run_defaults(const Experiment_context& context);
std::string run_every_frame(const Experiment_context& context);
std::string run_first_answer(const Experiment_context& context);
std::string run_growth(const Experiment_context& context);
std::string run_many_bodies(const Experiment_context& context);
std::string run_modes(const Experiment_context& context);
std::string run_nested_codebook(const Experiment_context& context);
std::string run_partitions(const Experiment_context& context);
std::string run_rebuild(const Experiment_context& context);
std::string run_peers(const Experiment_context& context);
std::string run_self_collision(const Experiment_context& context);
std::string run_soak(const Experiment_context& context);
std::string run_threads(const Experiment_context& context);
std::string run_volumes(const Experiment_context& context);

std::span<const Experiment> experiments() {
  static const auto all = std::to_array<Experiment>({
      {"teapot_sphere",
       "How well and how fast does the method find collisions on the paper's pair?",
       run_teapot_sphere,
       {"--scenes"}},
      {"scaling", "How do partition, detection and repartition check grow with k, M and N?", run_scaling, {"--scenes"}},
      {"predecessor",
       "Where does the predecessor fail, and does this method hold there?",
       run_predecessor,
       {"--scenes"}},
      {"collision_distance",
       "Why is mu the mean over adjacent vertices, not over all?",
       run_collision_distance,
       {"--scenes"}},
      {"every_frame",
       "Do the modes equal exhaustive checking in every frame of the scenes?",
       run_every_frame,
       {"--scenes", "--only", "--shard", "--merge-shards"}},
      {"growth",
       "Does repartitioning keep an inflating object detectable, and what does it cost?",
       run_growth,
       {"--scenes"}},
      {"modes", "What does a frame cost in each mode, and what does it miss?", run_modes, {"--scenes", "--only"}},
      {"defaults",
       "What do particles find, and what does a frame take, with other options than the defaults?",
       run_defaults,
       {"--scenes", "--only"}},
      {"nested_codebook",
       "Below the regions: do LBG's own splits find more for less than splits at medians?",
       run_nested_codebook,
       {"--scenes", "--only"}},
      {"many_bodies", "How does the time of a frame grow with the number of bodies?", run_many_bodies, {"--only"}},
      {"certified",
       "What does a frame cost where objects say how they move, and only what is near is posed?",
       run_certified,
       {"--scenes", "--only", "--write-meshes"}},
      {"partitions",
       "Which partition strategy is best, by its measures and in use?",
       run_partitions,
       {"--only", "--jobs", "--shard", "--merge-shards", "--strategy-file", "--write-meshes"}},
      {"rebuild", "When does a tree of the mode exact become too loose, and does a rebuild pay?", run_rebuild},
      {"self_collision", "How fast is self-collision of a deforming mesh, beside CGAL?", run_self_collision},
      {"soak",
       "Does mode exact ever differ from exhaustive checking?",
       run_soak,
       {"--shard", "--merge-shards", "--seeds"}},
      {"certified_soak",
       "Does mode certified ever differ from mode exact, or a vertex leave its bound?",
       run_certified_soak,
       {"--shard", "--merge-shards", "--seeds"}},
      {"threads", "How much faster are several threads than one?", run_threads, {"--only"}},
      {"volumes",
       "What does refitting bounding volumes cost per frame, and which are tightest?",
       run_volumes,
       {"--scenes", "--only"}},
#ifdef LODESTONE_PEERS
      {"peers", "How do other collision libraries fare on the same frames?", run_peers, {"--scenes", "--only"}},
      {"first_answer",
       "What does the first answer about two meshes cost, and from which frame on does a build pay?",
       run_first_answer,
       {"--only"}},
#endif
  });
  return all;
}

}  // namespace lodestone
