// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lodestone/detection/frame.h"
#include "lodestone/io/results/page.h"
#include "lodestone/triangles/triangle_intersection.h"

/// What files of results show of a frame: alike in the program, in Python and in the browser.
namespace lodestone {

/// Gives the triangle of a face of an object.
using Triangle_of_face = std::function<Triangle(Object_id, std::uint32_t)>;

/// Where the faces of a contact meet: the corners of a point, a segment or a polygon. Of faces that are near but apart:
/// the nearest point of each.
Intersection_points meeting_points(const Frame& frame, const Pair_result& pair, std::size_t contact,
                                   const Triangle_of_face& triangle_of);

/// The contacts of a frame: per contact an entry for each side of a polygon, or one for a segment, a point or a gap.
std::vector<Page_contact> page_contacts(const Frame& frame, const Triangle_of_face& triangle_of);

/// What is known of a frame beside its contacts.
struct Page_outcome {
  bool positive = false;               ///< whether surfaces intersect, found or not
  bool with_tolerance = false;         ///< whether objects can be near without colliding
  std::optional<double> nearest = {};  ///< distance of the two nearest objects; none: not known
};

/// Times and outcome of a frame, as docs/page_format.md describes: `Page_frame::stages`.
std::string page_stages(const Frame& frame, const Page_outcome& outcome);

}  // namespace lodestone
