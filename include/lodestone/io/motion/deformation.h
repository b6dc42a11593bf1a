// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "lodestone/io/motion/motion.h"
#include "lodestone/mesh/concepts.h"

/// Built-in motions: formulas that move a rest shape, so that an experiment needs no animation file.
///
/// In the formulas x is the position that the deformation before it gave, c the middle of the rest shape's bounding
/// box, s half of that box's diagonal and t the number of the frame. Those that swing do so by
///
///     swing(t) = sin(2 pi (t / period + phase)),   or 1 at all times if the period is 0.
///
/// Directions need not be unit vectors.
namespace lodestone {

/// A sine wave that travels through the shape. With k = pi waves / s, a(t) = 2 pi (t / period + phase) and d = x - c:
///
///     x + amplitude s (sin(k d.y + a), sin(k d.z + a + 2 pi / 3), sin(k d.x + a + 4 pi / 3))
///
/// Each coordinate is moved by the next one, which keeps the volume nearly as it is.
struct Wobble {
  double amplitude = 0.03;  ///< of s; finite
  double waves = 1;         ///< along the box's diagonal; finite
  double period = 60;       ///< frames; >= 0; 0: the wave stands still
  double phase = 0;         ///< turns; finite
};

/// Bends the shape's middle line into an arc, by `degrees` swing(t) over the length of the rest shape along `axis`.
///
/// With u and w the coordinates of x - c along `axis` and `towards`, and K the angle per length:
///
///     u' = sin(K u) / K - w sin(K u),   w' = (1 - cos(K u)) / K + w cos(K u)
///
/// Both ends move to the side of `towards`.
struct Bend {
  Kernel::Vector_3 axis{1, 0, 0};     ///< the line that becomes an arc; not zero
  Kernel::Vector_3 towards{0, 0, 1};  ///< where the ends go; made perpendicular to `axis`, to which it is not parallel
  double degrees = 30;                ///< finite
  double period = 60;                 ///< frames; >= 0
  double phase = 0;                   ///< turns; finite
};

/// Turns each point around the line through c along `axis`, by `degrees` swing(t) over the length of the rest shape
/// along `axis`: the middle stays, the ends turn by half of it in opposite directions.
struct Twist {
  Kernel::Vector_3 axis{0, 0, 1};  ///< not zero
  double degrees = 30;             ///< finite
  double period = 60;              ///< frames; >= 0
  double phase = 0;                ///< turns; finite
};

/// Scales around c: by 1 in frame 0, growing evenly to `factor` in frame `frames`, and by `factor` from then on.
struct Inflate {
  double factor = 2;    ///< finite, > 0
  double frames = 100;  ///< > 0
};

/// A place on the way of `Travel`.
struct Way_point {
  double frame = 0;              ///< when the shape is there
  Kernel::Vector_3 at{0, 0, 0};  ///< how far it is from where the deformations before it left it
};

enum class Path {
  linear,  ///< straight and at even speed between way points
  smooth,  ///< a cubic through the way points, whose velocity there is the mean one between the two neighbours
  closed   ///< as `smooth`, repeated for ever; the last way point ends where the first stands
};

/// Moves the shape along way points. Before the first and after the last it stands, unless the path is closed.
struct Travel {
  std::vector<Way_point> way_points;  ///< at least one (closed: three), frames strictly increasing
  Path path = Path::smooth;
};

/// Turns the shape around the line through c along `axis`, by `degrees_per_frame` t.
struct Spin {
  Kernel::Vector_3 axis{0, 0, 1};  ///< not zero
  double degrees_per_frame = 1;    ///< finite
};

using Deformation = std::variant<Wobble, Bend, Twist, Inflate, Travel, Spin>;

/// @throws Bad_argument when a field is outside its documented range
void check(const Deformation& deformation);

/// The motion that applies `deformations` in their order to `rest`, for any number of frames; none: it stands still.
///
/// Positions depend on nothing but the frame's number: the same frame gives the same bytes, in any order of calls.
/// O(vertices x deformations) per frame.
///
/// @throws Bad_argument as `check` does; Bad_motion by `pose` for another number of positions than `rest` has
Motion deform(std::vector<Point> rest, std::vector<Deformation> deformations);

}  // namespace lodestone
