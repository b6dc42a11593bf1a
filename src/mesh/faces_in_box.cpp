// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/faces_in_box.h"

#include <algorithm>
#include <limits>

#include "mesh/sides_kernel.h"

namespace lodestone {

namespace {

/// Coordinates that are looked at together: whole positions, and whole vectors of any width.
constexpr std::size_t block = 24;

/// Column i of a block is an x, y or z, by i modulo 3.
struct Columns {
  double low[block], high[block], zero[block];

  Columns() {
    std::ranges::fill(low, std::numeric_limits<double>::infinity());
    std::ranges::fill(high, -std::numeric_limits<double>::infinity());
    std::ranges::fill(zero, 0);
  }
  void add(std::size_t column, double x) {
    low[column] = x < low[column] ? x : low[column];
    high[column] = x > high[column] ? x : high[column];
    zero[column] += 0 * x;  // stays zero unless a coordinate is not finite
  }
};

}  // namespace

bool bound_positions(Coordinates coordinates, Box& box) {
  Columns columns;
  const std::size_t whole = coordinates.size() / block * block;
  for (std::size_t first = 0; first < whole; first += block)
    for (std::size_t column = 0; column < block; ++column) columns.add(column, coordinates[first + column]);
  for (std::size_t i = whole; i < coordinates.size(); ++i) columns.add(i - whole, coordinates[i]);
  box.setEmpty();
  double zero = 0;
  for (std::size_t column = 0; column < block; ++column) {
    const auto axis = static_cast<Eigen::Index>(column % 3);
    box.min()[axis] = std::min(box.min()[axis], columns.low[column]);
    box.max()[axis] = std::max(box.max()[axis], columns.high[column]);
    zero += columns.zero[column];
  }
  return zero == 0;
}

std::uint8_t sides_beyond(const double* position, const Box& box) {
  std::uint8_t sides = 0;
  kernel::sides_beyond(position, 1, box.min().data(), box.max().data(), &sides);
  return sides;
}

Unset_vector<std::uint8_t> sides_beyond(Coordinates coordinates, const Box& box) {
  Unset_vector<std::uint8_t> sides(coordinates.size() / 3);
  kernel::sides_beyond(coordinates.data(), sides.size(), box.min().data(), box.max().data(), sides.data());
  return sides;
}

void select_faces(const Faces_in_box& faces, const Box& part, Faces_in_box& found) {
  const auto beyond = sides_beyond(faces.coordinates, part);
  found.coordinates = faces.coordinates;
  for (std::size_t i = 0; i < faces.faces.size(); ++i) {
    const auto& [p, q, r] = faces.corners[i];
    if ((beyond[p] & beyond[q] & beyond[r]) != 0) continue;
    found.faces.push_back(faces.faces[i]);
    found.corners.push_back(faces.corners[i]);
  }
}

}  // namespace lodestone
