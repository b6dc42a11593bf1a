// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/mesh_guard.h"

#include <fmt/format.h>

namespace lodestone {

std::string too_short_for(std::size_t count, const std::string& things, std::size_t bytes_left) {
  return fmt::format("{} {} do not fit into the {} bytes that follow", count, things, bytes_left);
}

std::string too_many_faces(std::size_t faces, std::size_t max_faces) {
  return fmt::format("{} faces or more, where at most {} are allowed", faces, max_faces);
}

std::string wrong_corners(std::size_t face, std::size_t corners, std::string_view expected) {
  return fmt::format("face {} (counted from 0) has {} corners, expected {}", face, corners, expected);
}

void copy_coordinates(Text_scanner& text, Guarded_mesh& mesh) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto word = text.next_word();
    if (word.empty()) text.fail(fmt::format("expected 3 coordinates, found {}", axis));
    mesh.coordinates.add_coordinate(text.number(word));
    mesh.plain.append(word) += axis < 2 ? ' ' : '\n';
  }
}

}  // namespace lodestone
