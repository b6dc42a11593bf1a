// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "lodestone/volumes/leaf_faces.h"

/// Two leaves, seen along a direction, built for several instruction sets and chosen at run time. All give the same
/// bits.
namespace lodestone::kernel {

/// Lists of faces are padded to a multiple of this.
constexpr std::size_t faces_per_step = 8;

/// The corners of the faces of a leaf.
struct Corner_columns {
  const double* numbers;  ///< nine columns: x of the first corner of each face, y, z, then those of the other corners
  std::size_t count;      ///< of faces, 1 to `most_leaf_faces`
  std::size_t stride;     ///< length of a column, a multiple of `faces_per_step`
};

/// From where to where something reaches along two axes across a direction, and along the direction.
struct Span {
  double low[3];
  double high[3];
};

/// The same for some faces of a leaf.
struct Face_spans {
  std::size_t count = 0;
  std::uint8_t faces[most_leaf_faces];  ///< which faces of the leaf
  double low[3][most_leaf_faces];
  double high[3][most_leaf_faces];
};

/// Two things are in line only if they overlap along both axes across the direction. Seen along it, the far end of b
/// must also lie ahead of the near end of a by `least`.
struct In_line {
  double slack[2];  ///< gaps across the direction that may be due to rounding
  double least;
};

/// Two faces, by their places in the lists.
struct Face_slots {
  std::uint8_t a, b;
};

/// Lists all faces of a leaf.
/// @param axes  three vectors; the last is the direction
/// @return from where to where all of them together reach
Span span_faces(const Corner_columns& corners, const double (&axes)[3][3], Face_spans& spans);

/// Drops the faces of a that are not in line with all of b together.
void keep_in_line_with(Face_spans& a, const Span& b, const In_line& rule);
/// Drops the faces of b that are not in line with all of a together.
void keep_in_line_with(const Span& a, Face_spans& b, const In_line& rule);

/// Lists the pairs of faces that are in line.
/// @param pairs  room for as many as there can be
/// @return their number
std::size_t list_in_line(const Face_spans& a, const Face_spans& b, const In_line& rule, Face_slots* pairs);

}  // namespace lodestone::kernel
