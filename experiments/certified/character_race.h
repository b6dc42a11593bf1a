// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "certified/rival.h"
#include "lodestone/bounds/bounded_surface.h"

namespace lodestone {

struct Character_race_options {
  std::size_t most_frames = 91;  ///< of a longer scene, spread evenly
  std::size_t passes = 3;        ///< over all frames; the least time of each frame counts
  double enough_seconds = 8;     ///< per rival and question; beyond, it starts no further pass
};

/// What one way took and answered on one scene.
struct Rival_figures {
  std::string name;
  bool is_library = false;
  std::vector<double> any_seconds = {}, all_seconds = {};  ///< per frame, posing included
  std::size_t missed = 0, invented = 0;                    ///< yes or no, over the frames
  std::size_t wrong_sets = 0;                              ///< frames whose set of face pairs is not that of `exact`
  bool gave_up = false;

  bool is_right() const { return !gave_up && missed + invented + wrong_sets == 0; }
};

/// What mode `certified` read and bounded, per frame.
struct Certified_counts {
  std::vector<double> any_read = {}, all_read = {};  ///< positions read, as a share of the vertices
  std::vector<double> nodes_bounded = {};            ///< for yes or no
  std::vector<double> near_faces = {};               ///< faces of the leaves posed for all pairs, as a share
  std::vector<double> touching_faces = {};           ///< faces in a face pair, as a share
  double tightness = 1;                              ///< see `bound_tightness`
  std::size_t violations = 0;
};

struct Character_figures {
  std::string scene;
  bool everything_is_near = false;
  std::size_t size = 0;                     ///< the number of triangles asked for, which is met only nearly
  std::size_t triangles = 0, vertices = 0;  ///< of both
  double influences = 0;                    ///< joints per vertex, mean
  std::vector<std::size_t> frames = {};
  std::size_t colliding = 0;  ///< frames
  double pose_seconds = 0;    ///< posing everything, median
  std::vector<Rival_figures> rivals = {};
  Certified_counts certified = {};
};

/// All rivals on the same frames.
///
/// They take turns pass by pass, and each pass starts with another rival. In its turn a rival plays all frames, first
/// with one question, then with the other. Setting the joints counts, and so does all that follows: posing, refitting,
/// asking. The truth is the answer of mode `exact` in its first pass; comparing with it is not timed.
Character_figures race(Character_scene& scene, const Character_race_options& options,
                       const std::function<void(double share)>& progress);

/// How much larger boxes from bounds are than boxes fitted to positions: the mean ratio of their extents, over the
/// leaves that mode `certified` has bounded or posed in the current pose and all nodes above them.
double bound_tightness(const Bounded_surface& surface, const Skinned_points& points);

}  // namespace lodestone
