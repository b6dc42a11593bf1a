// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// To which side the faces of a component look: the side from which their corners are counter-clockwise.
///
/// Two faces agree if they run along their common edge in opposite directions. A component is open if some edge has an
/// odd number of faces. A cavity within another component looks inward by design.
enum class Face_orientation {
  outward,       ///< closed, all faces agree, and the enclosed volume is positive
  inward,        ///< closed, all faces agree, and the enclosed volume is negative
  mixed,         ///< closed, with outward and inward parts that meet only in vertices or edges of four or more faces
  inconsistent,  ///< closed, but some faces disagree
  no_volume,     ///< closed, all faces agree, and they enclose a volume of zero
  open,          ///< open, all faces agree
  open_inconsistent,  ///< open, and some faces disagree
};

/// All of them, in the order in which reports list them.
inline constexpr Face_orientation face_orientations[] = {
    Face_orientation::outward,          Face_orientation::inward,    Face_orientation::mixed,
    Face_orientation::inconsistent,     Face_orientation::no_volume, Face_orientation::open,
    Face_orientation::open_inconsistent};

/// How reports write an orientation.
struct Orientation_words {
  std::string_view name;    ///< as JSON has it: `open_inconsistent`
  std::string_view phrase;  ///< as text has it: `open and inconsistent`
};

/// How reports write this one.
Orientation_words words_of(Face_orientation orientation);

/// A set of faces connected through shared vertices.
struct Component_orientation {
  std::uint32_t first_face = 0;                           ///< the lowest index of its faces
  std::size_t faces = 0;                                  ///< how many it has
  Face_orientation orientation = Face_orientation::open;  ///< to which side they look
};

/// The orientation of each component, in the order of their first faces. The sign of a volume is exact: where interval
/// arithmetic cannot decide it, rational numbers do.
///
/// O((V + F) log F). Rational numbers take some microseconds per face.
/// @param points     finite
/// @param faces      vertex indices, each below the number of points
/// @param file_face  per face: the face in the file that it is a triangle of, as in Mesh_file; then `first_face` and
///                   `faces` count faces of the file. Empty: each face is one of the file.
std::vector<Component_orientation> component_orientations(std::span<const Point> points, std::span<const Corners> faces,
                                                          std::span<const std::uint32_t> file_face = {});

}  // namespace lodestone
