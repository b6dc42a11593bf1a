// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "lodestone/io/scenes/scene_file.h"
#include "shared/entrant.h"

namespace lodestone {

/// How much of a scene is measured. Slow entries are measured less often, by these rules.
struct Race_options {
  std::size_t triangles = 15'000'000;        ///< of all sampled frames together: decides how many are sampled
  std::size_t least_frames = 6;              ///< sampled at least
  std::size_t most_frames = 30;              ///< sampled at most
  std::size_t passes = 5;                    ///< over all sampled frames
  double seconds = 3;                        ///< per entry and scene; beyond, it starts no third or later pass
  double most_seconds = 60;                  ///< per entry and scene; beyond, it plays no further frame
  double approach_seconds = 20;              ///< between sampled frames; beyond, an entry starts no further pass
  std::size_t bytes = std::size_t{4} << 30;  ///< of the entries that take turns, see `measure_race`
};

/// Seconds in one frame, each the least over the passes.
struct Frame_seconds {
  double update = 0;
  double any = 0;
  double all = 0;
  double update_and_any = 0;
  double update_and_all = 0;
};

/// Figures of one entry on one scene.
struct Entry_figures {
  Entry entry;
  double build_seconds = 0;
  std::size_t bytes = 0;                   ///< that the build took from the heap and kept, or `Entrant::bytes`
  std::size_t passes = 0;                  ///< over all frames together
  std::vector<Frame_seconds> frames = {};  ///< per sampled frame that it played
  bool gave_up = false;                    ///< in the last of these frames; only its update counts
  bool left_early = false;                 ///< it did not finish all frames
  std::size_t missed = 0;                  ///< collisions not seen, one per frame and object pair
  std::size_t invented = 0;                ///< collisions seen where there are none
  std::size_t wrong_sets = 0;              ///< sets of face pairs that are not the true one, per frame and object pair
  std::size_t missing_pairs = 0;           ///< true face pairs that these sets lack
  std::size_t false_pairs = 0;             ///< face pairs in these sets that do not intersect
  std::size_t wrong_later = 0;             ///< frames with a wrong answer in a later pass, if the first had none

  /// Right in every frame of the scene.
  bool any_is_right() const { return entry.answers && !left_early && missed + invented + wrong_later == 0; }
  bool all_is_right() const { return any_is_right() && entry.reports_pairs && wrong_sets == 0; }
};

struct Scene_figures {
  std::string name;
  std::size_t objects = 0;
  std::size_t triangles = 0;              ///< of all objects
  std::size_t vertices = 0;               ///< of all objects
  std::size_t frames = 0;                 ///< of the scene
  std::vector<std::size_t> sampled = {};  ///< indices of the frames that were measured
  std::size_t asked = 0;                  ///< object pairs, in all these frames
  std::size_t colliding = 0;              ///< of these, how many collide
  std::size_t contacts = 0;               ///< true face pairs of all of them
  std::size_t batches = 0;                ///< groups of entries that took turns
  std::vector<Entry_figures> entries = {};
};

/// Indices of `count` samples spread evenly over a range: the middles of as many equal parts. All indices if the range
/// holds no more.
std::vector<std::size_t> spread(std::size_t range, std::size_t count);

/// Plays sampled frames of a scene with all entries.
///
/// Frames in which no two objects are near are left out, because any broad phase answers them. The race looks at four
/// times as many frames as it needs, and samples evenly those in which objects are near. It asks about the object
/// pairs whose boxes overlap. Finding these is not timed, so every entry gets that broad phase for free.
///
/// The entries take turns pass by pass, and each pass starts with another entry. In its turn an entry plays all sampled
/// frames one after the other, once per round, as it would if it were alone. Before each frame the race writes the
/// positions into the meshes, as a simulation does. That, the truth and the comparison with it are not timed.
///
/// Entries whose hierarchies do not fit into `bytes` together are split into batches. Each batch plays the same frames.
///
/// @param progress  share of the work that is done; may throw to stop
Scene_figures measure_race(Scene& scene, std::span<const Entry> entries, const Race_options& options,
                           const std::function<void(double)>& progress);

}  // namespace lodestone
