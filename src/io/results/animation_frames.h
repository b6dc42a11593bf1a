// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "lodestone/io/results/animation_output.h"

namespace lodestone {

/// The frames to write, in order.
class Animation_frames {
 public:
  /// @param output  named in errors
  /// @param passes  how many times all frames will be read, for the progress
  Animation_frames(std::filesystem::path output, const Animation& animation, const Animation_output_options& options,
                   std::size_t passes = 1);

  std::size_t size() const { return numbers_.size(); }
  /// Time of the i-th frame in seconds.
  float time(std::size_t i) const {
    return static_cast<float>(options_.start + static_cast<double>(i) / options_.frames_per_second);
  }
  /// Positions of the i-th frame of the output, in doubles; valid until the next call.
  /// @throws Bad_motion
  std::span<const Point> positions(std::size_t i);
  /// The same in floats: x y z, vertex by vertex.
  /// @throws Bad_motion  a coordinate is too large for a float, or all of a frame are too small for one
  std::span<const float> floats(std::size_t i);

 private:
  std::filesystem::path output_;
  const Animation& animation_;
  const Animation_output_options& options_;
  std::vector<std::size_t> numbers_;
  std::vector<Point> positions_;
  std::vector<float> floats_;
  std::size_t done_ = 0, passes_;
};

/// Writes `.gltf` or `.glb`.
void write_gltf(const std::filesystem::path& output, const Animation& animation,
                const Animation_output_options& options);

}  // namespace lodestone
