// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "lodestone/io/motion/motion.h"
#include "lodestone/mesh/concepts.h"

/// Built-in motions: formulas that move a rest shape, so that an experiment needs no animation file.
///
/// In the formulas, x is the position after the preceding deformation, c the centre of the rest shape's bounding box,
/// s half of that box's diagonal, and t the frame index. Periodic deformations use
///
///     swing(t) = sin(2 pi (t / period + phase)),   or 1 in every frame if the period is 0.
///
/// Directions need not be unit vectors.
namespace lodestone {

/// A sine wave that travels through the shape. With k = pi waves / s, a(t) = 2 pi (t / period + phase) and d = x - c:
///
///     x + amplitude s (sin(k d.y + a), sin(k d.z + a + 2 pi / 3), sin(k d.x + a + 4 pi / 3))
///
/// The offset of each coordinate depends on the next coordinate, which nearly preserves the volume.
struct Wobble {
  double amplitude = 0.03;  ///< of s; finite
  double waves = 1;         ///< number of waves along the box's diagonal; finite
  double period = 60;       ///< frames; >= 0; 0: the wave does not travel
  double phase = 0;         ///< turns; finite
};

/// Bends the shape's centre line into an arc of `degrees` swing(t) over the length of the rest shape along `axis`.
///
/// With u and w the coordinates of x - c along `axis` and `towards`, and K the angle per unit of length:
///
///     u' = sin(K u) / K - w sin(K u),   w' = (1 - cos(K u)) / K + w cos(K u)
///
/// Both ends move towards `towards`.
struct Bend {
  Kernel::Vector_3 axis{1, 0, 0};     ///< the line that becomes an arc; not zero
  Kernel::Vector_3 towards{0, 0, 1};  ///< where the ends go; not parallel to `axis`, and made perpendicular to it
  double degrees = 30;                ///< finite
  double period = 60;                 ///< frames; >= 0
  double phase = 0;                   ///< turns; finite
};

/// Rotates each point around the line through c along `axis`. The two ends of the rest shape along `axis` turn by
/// `degrees` swing(t) against each other, each by half of that angle; the middle stays.
struct Twist {
  Kernel::Vector_3 axis{0, 0, 1};  ///< not zero
  double degrees = 30;             ///< finite
  double period = 60;              ///< frames; >= 0
  double phase = 0;                ///< turns; finite
};

/// Scales around c: by 1 in frame 0, linearly to `factor` in frame `frames`, and by `factor` from then on.
struct Inflate {
  double factor = 2;    ///< finite, > 0
  double frames = 100;  ///< > 0
};

/// A position on the path of `Travel`.
struct Way_point {
  double frame = 0;              ///< when the shape is there
  Kernel::Vector_3 at{0, 0, 0};  ///< offset from where the preceding deformations put it
};

/// How `Travel` moves between way points.
enum class Path {
  linear,  ///< straight and at constant speed between way points
  smooth,  ///< a cubic through the way points; the velocity at each is the mean velocity between its two neighbours
  closed   ///< as `smooth`, repeated for ever; the last way point has the position of the first
};

/// Moves the shape along way points. It rests before the first and after the last, unless the path is closed.
struct Travel {
  std::vector<Way_point> way_points;  ///< at least one (closed: three), frames strictly increasing
  Path path = Path::smooth;           ///< between the way points
};

/// Rotates the shape around the line through c along `axis`, by `degrees_per_frame` t.
struct Spin {
  Kernel::Vector_3 axis{0, 0, 1};  ///< not zero
  double degrees_per_frame = 1;    ///< finite
};

/// Any built-in deformation.
using Deformation = std::variant<Wobble, Bend, Twist, Inflate, Travel, Spin>;

/// Refuses a deformation with a field out of range.
/// @throws Bad_argument  a field is outside its documented range
void check(const Deformation& deformation);

/// The motion that applies `deformations` in order to `rest`, for any number of frames. Without deformations the shape
/// does not move.
///
/// Positions depend on the frame index alone: the same frame gives the same bytes, in any order of calls.
/// O(vertices x deformations) per frame.
///
/// @throws Bad_argument  as `check`
/// @throws Bad_motion    from `pose`: the number of positions differs from that of `rest`
Motion deform(std::vector<Point> rest, std::vector<Deformation> deformations);

}  // namespace lodestone
