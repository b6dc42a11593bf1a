// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "lodestone/io/motion/animation.h"

namespace lodestone {

struct Animation_output_options {
  std::vector<std::size_t> frames = {};    ///< of the motion, in the order of the output; empty: all
  double frames_per_second = 30;           ///< of the output; > 0
  std::vector<Region_index> regions = {};  ///< per vertex: glTF gets a colour for each; empty: none
  /// Called between frames; may throw to give up, and then nothing is written.
  std::function<void(std::size_t done, std::size_t of)> progress = {};
};

/// Writes an animation, by the extension of `output`: a point cache `.pc2` or `.mdd`, glTF `.gltf` (with a `.bin`
/// beside it) or `.glb`, or `.obj`, `.off`, `.ply`: a pattern of numbered files, counted from 0, or one frame. Frame by
/// frame; what is written appears whole or not at all.
///
/// Vertices and faces keep their order. glTF holds the first frame, a morph target per further frame, and an animation
/// that shows one after the other, straight from frame to frame: positions as floats, at most 2048 frames. Point caches
/// hold floats too, mesh files doubles.
///
/// @throws Bad_motion    a frame is broken, a coordinate is too large for a float
/// @throws Bad_argument  an extension not listed, no faces where they are needed, too many frames for the format
/// @throws Bad_output
void write_animation(const std::filesystem::path& output, const Animation& animation,
                     const Animation_output_options& options = {});

}  // namespace lodestone
