// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include "lodestone/detection/detector_options.h"
#include "lodestone/detection/frame.h"

namespace lodestone {

/// What was checked of one scene; the counts are sums over the frames.
struct Frame_checks {
  std::size_t frames = 0;
  std::size_t pairs = 0;          ///< of objects
  std::size_t intersecting = 0;   ///< of these
  std::size_t face_pairs = 0;     ///< true ones
  std::size_t wrong_answers = 0;  ///< of the modes that find all
  std::size_t wrong_sets = 0;     ///< of the same: other face pairs than the true ones
  std::size_t invented = 0;       ///< collisions and face pairs of the other modes that are none
};

/// Compares what a detector answered about two objects with the truth, and adds what is wrong.
/// @param options  of the detector: what it was asked, and whether its mode must find all
/// @param truth    all face pairs of the two that intersect, sorted
void compare_with_truth(const Frame& answer, Object_pair pair, std::span<const Face_pair> truth,
                        const Detector_options& options, Frame_checks& checked);

}  // namespace lodestone
