// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/grid.h"

#include <algorithm>
#include <vector>

#include "lodestone/mesh/scaled_positions.h"
#include "partition/used_surface.h"

namespace lodestone {

namespace {

/// The indices of a cube along x, y and z, 21 bits each.
using Cube = std::uint64_t;

/// The finest grid has this many cubes along the longest side.
constexpr double most_cubes = 1 << 20;

/// Cube of each vertex.
/// @param offsets  V x 3, from the lower corner of the bounding box
std::vector<Cube> cubes(const Positions& offsets, double size) {
  std::vector<Cube> result(static_cast<std::size_t>(offsets.rows()));
  for (std::size_t v = 0; v < result.size(); ++v)
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      result[v] = result[v] << 21 | static_cast<Cube>(offsets(static_cast<Eigen::Index>(v), axis) / size);
  return result;
}

/// The different cubes, ascending.
std::vector<Cube> occupied(std::vector<Cube> cubes) {
  std::ranges::sort(cubes);
  cubes.erase(std::unique(cubes.begin(), cubes.end()), cubes.end());
  return cubes;
}

/// Searches for the cube size at which the number of occupied cubes is as large as possible, but at most `wanted`. Of
/// equally good sizes it takes the smallest, because that cuts off the last cubes along each axis least.
class Size_search {
 public:
  Size_search(const Positions& offsets, std::size_t wanted)
      : offsets_(offsets), wanted_(wanted), extent_(offsets.maxCoeff()), best_(2 * extent_) {}

  void run() {
    double low = extent_;
    while (fits(low)) {
      if (low <= extent_ / most_cubes) return;
      low /= 2;
    }
    // After so many, sizes differ by little more than rounding.
    constexpr int bisections = 30;
    double high = 2 * low;
    for (int i = 0; i < bisections; ++i) {
      const double middle = (low + high) / 2;
      (fits(middle) ? high : low) = middle;
    }
  }

  double best() const { return best_; }
  std::size_t tried() const { return tried_; }

 private:
  /// Whether no more cubes are occupied than wanted.
  bool fits(double size) {
    ++tried_;
    const std::size_t count = occupied(cubes(offsets_, size)).size();
    if (count > wanted_) return false;
    if (count > most_ || (count == most_ && size < best_)) {
      most_ = count;
      best_ = size;
    }
    return true;
  }

  const Positions& offsets_;
  std::size_t wanted_;
  double extent_;
  double best_;
  std::size_t most_ = 1;  ///< cubes occupied at the best size; at twice the extent there is one
  std::size_t tried_ = 0;
};

Labelling label_grid(const Numbered_surface& surface, std::size_t regions) {
  Positions offsets = scaled_positions(surface.positions);
  offsets.rowwise() -= offsets.colwise().minCoeff().eval();
  if (offsets.maxCoeff() == 0) return {.labels = std::vector<Region_index>(offsets.rows(), 0)};

  Size_search search(offsets, regions);
  search.run();

  const auto cube_of_vertex = cubes(offsets, search.best());
  const auto occupied_cubes = occupied(cube_of_vertex);
  Labelling labelling{.labels = {}, .iterations = search.tried()};
  for (const auto cube : cube_of_vertex)
    labelling.labels.push_back(
        static_cast<Region_index>(std::ranges::lower_bound(occupied_cubes, cube) - occupied_cubes.begin()));
  return labelling;
}

}  // namespace

Labelling Grid::label(const Numbered_surface& surface, std::size_t regions) const {
  return label_used(surface, regions, label_grid);
}

}  // namespace lodestone
