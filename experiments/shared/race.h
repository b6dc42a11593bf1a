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

/// How much of a scene is measured. What is slow is measured less often, by rules that a reader can check.
struct Race_options {
  std::size_t triangles = 15'000'000;        ///< of all sampled frames together; decides how many frames are sampled
  std::size_t least_frames = 6;              ///< but at least so many
  std::size_t most_frames = 30;              ///< and at most so many
  std::size_t passes = 5;                    ///< over all sampled frames
  double seconds = 3;                        ///< per entry and scene; beyond it an entry plays no third pass
  double most_seconds = 60;                  ///< per entry and scene; beyond it an entry plays no further frame
  double approach_seconds = 20;              ///< of an entry between sampled frames; beyond it it plays no second pass
  std::size_t bytes = std::size_t{4} << 30;  ///< of entries that live at the same time, see `measure_race`
};

/// Seconds in one frame: for each figure the least over the passes.
struct Frame_seconds {
  double update = 0;
  double any = 0;
  double all = 0;
  double update_and_any = 0;
  double update_and_all = 0;
};

/// What one entry gave on one scene.
struct Entry_figures {
  Entry entry;
  double build_seconds = 0;
  std::size_t bytes = 0;                   ///< taken by the build and kept: of the heap, or see `Entrant::bytes`
  std::size_t passes = 0;                  ///< over all frames together
  std::vector<Frame_seconds> frames = {};  ///< per sampled frame that it played
  bool gave_up = false;                    ///< in the last of these frames, of which only the update counts
  bool left_early = false;                 ///< it did not play all frames, or not to the end
  std::size_t missed = 0;                  ///< collisions not seen, frames and object pairs counted one by one
  std::size_t invented = 0;                ///< collisions seen where there are none
  std::size_t wrong_sets = 0;              ///< frames and object pairs whose set of face pairs is not the true one
  std::size_t missing_pairs = 0;           ///< face pairs not in these sets
  std::size_t false_pairs = 0;             ///< face pairs in these sets that do not intersect
  std::size_t wrong_later = 0;             ///< frames right in the first pass, wrong in a later one

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
  std::vector<std::size_t> sampled = {};  ///< numbers of the frames that were measured
  std::size_t asked = 0;                  ///< object pairs, in all these frames
  std::size_t colliding = 0;              ///< of these, how many collide
  std::size_t contacts = 0;               ///< true face pairs of all of them
  std::size_t batches = 0;                ///< groups of entries that took turns
  std::vector<Entry_figures> entries = {};
};

/// Places of `count` samples spread evenly over a range: the middles of as many equal parts; all if there are no more.
std::vector<std::size_t> spread(std::size_t range, std::size_t count);

/// Plays sampled frames of a scene with all entries.
///
/// Frames in which no two bounding boxes overlap are left out: there any broad phase has the answer. The others are
/// sampled evenly, from four times as many that are looked at. Asked about are the object pairs whose boxes overlap;
/// who needs that broad phase has it as a gift, for it is not timed.
///
/// The entries take turns pass by pass, another one first each time: in its turn an entry plays all sampled frames one
/// after the other, once per round, as it would if it were alone. Before each frame positions are written into the
/// meshes, as a simulation does. That, the truth and the comparison with it are not timed.
///
/// Entries whose hierarchies do not fit into `bytes` together play the same frames one batch after the other.
///
/// @param progress  share of the work that is done; may throw to stop
Scene_figures measure_race(Scene& scene, std::span<const Entry> entries, const Race_options& options,
                           const std::function<void(double)>& progress);

}  // namespace lodestone
