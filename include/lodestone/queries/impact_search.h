// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lodestone/mesh/pairs.h"
#include "lodestone/tree/tree_view.h"
#include "lodestone/triangles/impact.h"

/// When two surfaces meet first, whose vertices move on straight lines while t goes from 0 to 1.
namespace lodestone {

/// A tree, with the positions and boxes at the start and at the end of a motion. Both have the same layout.
struct Swept_view {
  Layout_view start;  ///< at t = 0, with boxes
  Layout_view end;    ///< at t = 1, with boxes
};

/// What a `Swept_view` needs beside a tree that is fitted to the start: the boxes at the end.
class Swept_boxes {
 public:
  /// Fits boxes to the end of the motion. O(V).
  /// @param start  with boxes; its tree must outlive this
  /// @param end    3 V coordinates, all finite; must stay where they are as long as this is used
  Swept_boxes(const Layout_view& start, Coordinates end);
  Swept_boxes(const Swept_boxes&) = delete;
  Swept_boxes& operator=(const Swept_boxes&) = delete;

  /// Both ends of the motion. Valid as long as this.
  const Swept_view& view() const { return view_; }

 private:
  std::vector<Aabb> boxes_;
  Swept_view view_;
};

/// The first moment at which two surfaces have a point in common.
struct Impact {
  Face_pair faces = {};         ///< the lowest pair of those that meet at this time
  double time = 0;              ///< t, in [0, 1]; the nearest double to the exact time
  Impact_time exact_time = {};  ///< t itself, to be compared
  /// A point on the first of the faces. At the exact time its distance from either face is at most 2^-46 of the
  /// largest coordinate that one of them has at the start or the end, and some times 2^-1074.
  Point point = {};
};

/// The earliest impact of two different objects: no pair of their faces meets before it. None if they never meet while
/// t goes from 0 to 1. Whether, when and where is decided exactly, as if all numbers were rational: see
/// `first_impact` of two triangles. Two objects that intersect at the start have an impact at t = 0: a search for all
/// contacts finds the lowest.
///
/// What meets within one mesh is not looked at: see `first_self_impact`.
///
/// Branch and bound over node pairs, those first whose moving boxes may overlap first. Only faces whose moving boxes
/// overlap before the earliest impact so far go to the exact test. O(log F) node pairs are opened where the surfaces
/// meet at one place; more where they run side by side. Where many face pairs meet at exactly the first time, such as
/// all of a block that falls flat on a floor, each of them takes an exact test of 10 to 60 us. Where block and floor
/// lie along the axes, nearly all of these tests are saved: a gap between the boxes tells that the pair is not earlier.
/// Long faces around one vertex that comes first, such as those of a cone's tip, have boxes that all overlap at once:
/// O(n^2) for n of them on each side.
///
/// @param latest  in [0, 1]; if the first time is later than this, the result is none
std::optional<Impact> first_impact(const Swept_view& a, const Swept_view& b, double latest = 1);

/// The earliest impact of two faces of one object that share no vertex, face pairs a < b. None if there is none while t
/// goes from 0 to 1. Faces that share a vertex are not looked at: they touch all the time.
///
/// As `first_impact`, but faces near each other are on their way close together from the start: some tens of them per
/// face go to the exact test of two triangles, whose floating-point part mostly tells them apart. O(F log F) on
/// surfaces of even faces that move little beside their size. Straight ways of a body that turns by half a turn lead
/// nearly all of its faces through one place, where all pairs of them are tested: O(F^2). Ask about shorter steps.
/// Nodes all of whose faces share a vertex are not compared.
///
/// @param surface  one object
/// @param latest   in [0, 1]; if the first time is later than this, the result is none
std::optional<Impact> first_self_impact(const Swept_view& surface, double latest = 1);

/// An impact of two of many objects.
struct Object_impact {
  Object_pair objects = {};  ///< by id, the lower one first
  Impact impact = {};        ///< of a face of each
};

/// Faces whose vertices move.
struct Moving_surface {
  std::span<const Corners> faces;  ///< F >= 1
  Coordinates start;               ///< 3 V, at t = 0, all finite
  Coordinates end;                 ///< 3 V, at t = 1, all finite
};

/// The same for surfaces without trees, which are built and thrown away. O(F log F).
std::optional<Impact> first_impact(const Moving_surface& a, const Moving_surface& b);

/// The same by the exact test of every face of a with every face of b: the truth that the search is compared with.
/// O(F_a F_b).
std::optional<Impact> exhaustive_first_impact(const Moving_surface& a, const Moving_surface& b);

/// `first_self_impact` of a surface without a tree, which is built and thrown away.
std::optional<Impact> first_self_impact(const Moving_surface& surface);

/// The same by the exact test of all face pairs that share no vertex. O(F^2).
std::optional<Impact> exhaustive_first_self_impact(const Moving_surface& surface);

}  // namespace lodestone
