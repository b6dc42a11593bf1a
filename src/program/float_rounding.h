// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>

#include "lodestone/mesh/mesh_numbering.h"

namespace lodestone {

/// What is lost where coordinates are written as floats.
struct Float_rounding {
  double largest = 0;          ///< by how much a coordinate changes at most, in units of the coordinates
  double diagonal = 0;         ///< of the bounding box
  bool of_difference = false;  ///< what is written is the difference to another frame

  /// In times of the diagonal; 0 for a point.
  double share() const { return diagonal > 0 ? largest / diagonal : 0; }
  /// Whether shapes suffer: floats of a mesh near the origin lose less.
  bool is_coarse() const { return share() > 1e-6; }
};

/// Of the vertices that faces use; of all vertices if there are no faces.
Float_rounding float_rounding(std::span<const Point> points, std::span<const Corners> faces);
/// The same where the floats are differences to another frame, as in glTF: far from that one they are coarse.
/// @param first  that frame; as many as `points`
Float_rounding float_rounding(std::span<const Point> points, std::span<const Point> first,
                              std::span<const Corners> faces);

/// Whether `write_animation` writes floats to a file of this extension.
bool stores_floats(const std::filesystem::path& output);

}  // namespace lodestone
