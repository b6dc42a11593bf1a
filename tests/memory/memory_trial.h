// SPDX-License-Identifier: GPL-3.0-or-later
// A scene whose detector runs out of memory, in one call, at one allocation after the other.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "detection/certified_scene.h"

namespace lodestone::test {

/// A mode, with options that make small meshes go through all of its stages.
struct Tried_mode {
  std::string name;
  Detector_options options;
};

/// All modes, with one thread and with two.
std::vector<Tried_mode> tried_modes();
/// Those that find everything.
std::vector<Tried_mode> exact_modes();
/// Those whose frames find nothing but face pairs, for the other queries that they answer.
std::vector<Tried_mode> plain_modes();

/// Two bodies, in mode `certified` of computed points, and their detector.
class Trial {
 public:
  explicit Trial(const Tried_mode& mode);
  Trial(const Trial&) = delete;

  /// Moves all bodies.
  void pose(int frame);
  /// Adds both bodies.
  void add_all();
  /// Adds the second body.
  Object_id add_second();
  /// Plays frames from 0 on.
  void play(int frames);

  Surface_mesh first, second, third;
  Skinned_points first_points, second_points;
  Detector<> detector;

 private:
  bool computed_;
};

/// One call that runs out of memory.
struct Tried_call {
  std::function<void(Trial&)> before;           ///< what comes before it
  std::function<void(Trial&)> call;             ///< the call
  std::function<void(Trial&)> after = nullptr;  ///< what must hold when it has failed
  bool repeated = true;                         ///< it is made again before the next frame
  /// Property maps are added to a CGAL::Surface_mesh, which loses one that there was no memory for.
  bool maps_are_made = false;
};

/// Repeats a call for each of its allocations, which fails: the call throws std::bad_alloc, the next frame is that of a
/// detector that never ran out of memory, and nothing leaks.
void expect_to_survive(const Tried_mode& mode, const Tried_call& tried);

}  // namespace lodestone::test
