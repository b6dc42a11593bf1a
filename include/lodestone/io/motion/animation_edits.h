// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

#include "lodestone/io/motion/animation.h"

/// Changes of a whole animation. Each takes an animation and returns the changed one; `motion.pose` applies the change
/// to each frame as it is read.
namespace lodestone {

/// Multiplies all coordinates.
/// @param factor  > 0
/// @throws Bad_argument  the factor is not positive and finite
/// @throws Bad_motion    from `pose`: a coordinate becomes infinite
Animation scaled(Animation animation, double factor);

/// Two vertices that were merged, and that a frame of the animation moves apart.
struct Parted_vertices {
  std::size_t frame = 0;     ///< that frame
  std::uint32_t kept = 0;    ///< the vertex that both follow: its index before they were merged
  std::uint32_t merged = 0;  ///< the other, likewise
  double distance = 0;       ///< between them, in that frame
};

/// Merges vertices that are near each other in the first frame. In the order of the file, each vertex joins the first
/// kept vertex that is at most `distance` away, and moves with it in all frames; if there is none, it is kept. Faces
/// that lose a corner are dropped. O(n log n) vertices.
/// @param distance  >= 0; 0: only vertices at the same position
/// @param parted    called by `pose` for a frame in which merged vertices would be farther apart than `distance`, by
///                  more than what is rounded to floats: with the two that are farthest apart. Null: nobody is told
/// @throws Bad_argument  the distance is negative or not finite; the mesh has no faces, or none is left
Animation welded(Animation animation, double distance, std::function<void(const Parted_vertices&)> parted = {});

/// Cuts every triangle into four at the midpoints of its edges, `times` times. The surface keeps its shape. New
/// vertices follow the old ones. Faces keep their place in the file.
/// @throws Bad_argument  the mesh has no faces, or would have more than 50 million
Animation subdivided(Animation animation, std::size_t times);

}  // namespace lodestone
