// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "lodestone/io/motion/animation.h"

namespace lodestone {

/// Options of `write_animation`.
struct Animation_output_options {
  std::vector<std::size_t> frames = {};    ///< frames of the motion, in output order; empty: all
  double frames_per_second = 30;           ///< of the output; > 0
  double start = 0;                        ///< time of the first frame in seconds, in glTF and MDD; >= 0 in glTF
  std::vector<Region_index> regions = {};  ///< per vertex: its region, shown as vertex colours in glTF; empty: none
  bool numbered = true;  ///< whether `*` and `#` in the name of a mesh file stand for the number of the frame
  /// Called between frames. If it throws, the output is abandoned and nothing is written.
  std::function<void(std::size_t done, std::size_t of)> progress = {};
};

/// When the first frame of a motion is, in seconds, where its frames follow each other at another rate. 0 if they have
/// no times, or begin before 0.
/// @param frames_per_second  > 0
double start_at(const Motion& motion, double frames_per_second);

/// Writes an animation in the format of `output`'s extension:
///
/// - a point cache: `.pc2`, `.mdd`
/// - glTF: `.gltf` (with a `.bin` beside it), `.glb`
/// - mesh files: `.obj`, `.off`, `.ply`, `.stl` (binary); a pattern of numbered files, counted from 0, or the name of a
///   single frame
///
/// Frames are processed one at a time. The output appears whole or not at all.
///
/// Vertices and faces keep their order. A glTF file has the first frame, and a morph target per further frame; at most
/// 2048 frames. Its animation shows the frames in order, with linear interpolation. glTF, STL and point caches store
/// floats, other mesh files doubles.
///
/// @throws Bad_motion    a frame is broken, a coordinate is too large for a float, or all of a frame are too small
/// @throws Bad_argument  an extension not listed, no faces where the format needs them, too many frames for the format,
///                       a rate or a start out of range, glTF that starts so late that floats change the time between
///                       two frames by more than a quarter
/// @throws Bad_output
void write_animation(const std::filesystem::path& output, const Animation& animation,
                     const Animation_output_options& options = {});

/// The files that `write_animation` writes for so many frames.
std::vector<std::filesystem::path> files_of(const std::filesystem::path& output, std::size_t frames);

}  // namespace lodestone
