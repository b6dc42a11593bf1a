// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/mesh/pairs.h"
#include "program/commands.h"
#include "program/frame_tally.h"
#include "program/measurement.h"
#include "program/scene_detector.h"

namespace lodestone {

/// The least distance of two objects over the frames of a run.
struct Least_distance {
  double distance = 0;    ///< in units of the coordinates
  std::size_t frame = 0;  ///< the first with that distance
};

/// When two objects meet first in a run.
struct First_impact {
  std::size_t frame = 0;  ///< the last one before it, or at that time
  double time = 0;        ///< on the way to the next frame: 0 to 1
};

/// The results of a run of `detect` for one object pair.
struct Pair_summary {
  std::size_t colliding_frames = 0;
  std::size_t near_frames = 0;                 ///< in which faces are nearer than the tolerance, or intersect
  std::size_t face_pairs = 0;                  ///< over all frames
  std::size_t capped_frames = 0;               ///< in which face pairs were dropped at the limit
  std::size_t unfinished_frames = 0;           ///< in which the budget of openings ended the search
  std::size_t contained_frames = 0;            ///< in which one object is inside the other
  std::optional<double> longest_parting = {};  ///< of the translations that part the two
  std::optional<std::size_t> first_colliding = {}, last_colliding = {};  ///< frames
  std::optional<Least_distance> least_distance = {};                     ///< with --closest
  std::optional<First_impact> first_impact = {};                         ///< with --impacts
  std::size_t passings = 0;     ///< with --impacts: steps in which the two meet, though they collide at neither end
  bool met_on_the_way = false;  ///< since the last frame, in which they did not collide
  Score score = {};

  /// Adds the next frame.
  void add(std::size_t frame, const Pair_result& pair);
  /// Ends the way to a frame that has been added.
  void end_way();
  /// Adds an impact on the way from that frame to the next.
  void add_impact(std::size_t frame, double time);
};

/// The results of a run of `detect` over its frames.
struct Run_summary {
  std::map<Object_pair, Pair_summary> pairs;
  Measurement measurement;
  std::size_t builds = 0;  ///< objects built, in all frames

  /// @param timed   whether the frame counts in the means and medians; building always counts
  void add(const Frame_tally& tally, bool timed);
  /// Whether any pair collides, is near, or meets on the way, in any frame.
  bool finds_any() const;
};

/// What a run is about.
struct Run_subject {
  const Detect_command& command;
  const Scene& scene;
  const Scene_detector* detector;         ///< null: the frames have been made without one
  const nlohmann::ordered_json& objects;  ///< as objects_json, if another process has made the frames; else null
  const std::string& revision;            ///< of the program that has made the frames

  /// Whether the truth about a pair is known. It is not known for self-collisions.
  bool has_truth(Object_pair pair) const { return command.truth && pair.a != pair.b; }
};

/// The objects of `summary.json`, as the detector has built them.
nlohmann::ordered_json objects_json(const Run_subject& subject);

/// The content of `summary.json`, of a run with a detector or with objects.
nlohmann::ordered_json summary_json(const Run_subject& subject, const Run_summary& summary);

/// One line: how many pairs collide, and when.
std::string one_line_answer(const Run_subject& subject, const Run_summary& summary);

/// Prints the table of the run, its times, and what its mode may have missed.
void print_summary(const Run_subject& subject, const Run_summary& summary);

}  // namespace lodestone
