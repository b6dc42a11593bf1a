// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "certified/character_scene.h"
#include "lodestone/io/scenes/scene_file.h"
#include "threads/moving_pair.h"

namespace lodestone {

/// A piece of work that detectors with different numbers of threads repeat on the same poses.
struct Threaded_work {
  std::string name;
  std::size_t rounds = 1;  ///< how often each number of threads has its turn
  /// Poses what the work is done on, for a round.
  std::function<void(std::size_t round)> pose;
  /// Makes a function that does the work once, with so many threads at most, and returns the seconds it took.
  std::function<std::function<double()>(std::size_t threads)> make;
};

/// What the machine allows: tasks that read and write nothing in common, long and short.
std::vector<Threaded_work> works_without_memory();
/// What can be asked about a pair of spheres: builds, queries and the stages of every mode.
std::vector<Threaded_work> works_on(Moving_pair& pair);
/// Mode `certified` on two characters.
std::vector<Threaded_work> works_on(Character_scene& scene);
/// Many small bodies, as of `crowd`.
std::vector<Threaded_work> works_on(Scene& crowd);

}  // namespace lodestone
