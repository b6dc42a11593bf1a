// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/morphed_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string_view>
#include <utility>

#include "lodestone/mesh/coordinates.h"
#include "lodestone/mesh/errors.h"
#include "mesh/pose_kernel.h"

namespace lodestone {

namespace {

void check(const Morph_target& target, std::size_t number, std::size_t vertex_count) {
  const auto require = [number](bool right, std::string_view what) {
    if (!right) throw Bad_argument(fmt::format("morph target {}: {}", number, what));
  };
  require(all_finite(target.offsets), "an offset is not finite");
  if (target.offsets.empty() && target.vertices.empty()) return;
  const std::size_t moved = target.vertices.empty() ? vertex_count : target.vertices.size();
  require(target.offsets.size() == 3 * moved,
          fmt::format("it has {} numbers for {} vertices, expected three for each", target.offsets.size(), moved));
  if (target.vertices.empty()) return;
  require(std::ranges::adjacent_find(target.vertices, std::greater_equal()) == target.vertices.end(),
          "its vertices do not ascend");
  require(target.vertices.back() < vertex_count,
          fmt::format("it moves vertex {} of {}", target.vertices.back(), vertex_count));
}

}  // namespace

Morphed_points::Morphed_points(std::vector<double> rest, std::span<const Morph_target> targets)
    : rest_(std::move(rest)), weights_(targets.size(), 0) {
  if (rest_.size() % 3 != 0 || rest_.size() / 3 > std::numeric_limits<std::uint32_t>::max() - block_vertices)
    throw Bad_argument(fmt::format("{} coordinates at rest, expected three for each vertex", rest_.size()));
  if (!all_finite(rest_)) throw Bad_argument("a coordinate at rest is not finite");
  for (std::size_t target = 0; target < targets.size(); ++target) check(targets[target], target, vertex_count());
  std::vector<std::size_t> next(targets.size(), 0);
  slice_begin_.push_back(0);
  for (std::uint32_t block = 0; block < block_count(); ++block) {
    add_slices(block, targets, next);
    slice_begin_.push_back(slices_.size());
  }
}

/// What each target adds to a block: from the first vertex that it moves there to the last.
/// @param next  per target: its first entry that is not in an earlier block
void Morphed_points::add_slices(std::uint32_t block, std::span<const Morph_target> targets,
                                std::vector<std::size_t>& next) {
  const std::uint32_t end_vertex = std::min(vertex_count(), (block + 1) * block_vertices);
  for (std::uint32_t number = 0; number < targets.size(); ++number) {
    const Morph_target& target = targets[number];
    const auto vertex_at = [&](std::size_t entry) {
      return target.vertices.empty() ? static_cast<std::uint32_t>(entry) : target.vertices[entry];
    };
    Slice slice{.target = number, .first = 0, .end = 0, .offsets = offsets_.size()};
    for (; 3 * next[number] < target.offsets.size() && vertex_at(next[number]) < end_vertex; ++next[number]) {
      const auto offset = std::span(target.offsets).subspan(3 * next[number], 3);
      if (offset[0] == 0 && offset[1] == 0 && offset[2] == 0) continue;
      const std::uint32_t vertex = vertex_at(next[number]);
      if (slice.end == 0) slice.first = slice.end = vertex;
      offsets_.resize(offsets_.size() + 3 * std::size_t{vertex - slice.end}, 0);
      offsets_.insert(offsets_.end(), offset.begin(), offset.end());
      slice.end = vertex + 1;
    }
    if (slice.end > 0) slices_.push_back(slice);
  }
}

void Morphed_points::set_weights(std::span<const double> weights) {
  if (weights.size() != weights_.size())
    throw Bad_argument(fmt::format("{} weights for {} morph targets", weights.size(), weights_.size()));
  if (!all_finite(weights)) throw Bad_argument("the weight of a morph target is not finite");
  std::ranges::copy(weights, weights_.begin());
  ++pose_number_;
}

std::span<const Morphed_points::Slice> Morphed_points::slices_of(std::uint32_t vertex) const {
  const std::size_t block = vertex / block_vertices;
  return std::span(slices_).subspan(slice_begin_[block], slice_begin_[block + 1] - slice_begin_[block]);
}

Eigen::Vector3d Morphed_points::operator()(std::uint32_t vertex) const {
  Eigen::Vector3d position = Eigen::Map<const Eigen::Vector3d>(rest_.data() + 3 * std::size_t{vertex});
  for_each_offset(vertex, [&](std::uint32_t target, std::span<const double, 3> offset) {
    if (weights_[target] != 0) position += weights_[target] * Eigen::Map<const Eigen::Vector3d>(offset.data());
  });
  return position;
}

void Morphed_points::pose(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const {
  for (const auto vertex : vertices)
    Eigen::Map<Eigen::Vector3d>(coordinates.data() + 3 * std::size_t{vertex}) = (*this)(vertex);
}

void Morphed_points::pose_block(std::uint32_t block, std::span<double> coordinates) const {
  const std::uint32_t first = block * block_vertices;
  std::ranges::copy(std::span(rest_).subspan(3 * std::size_t{first}, coordinates.size()), coordinates.begin());
  for (const Slice& slice : slices_of(first))
    if (const double weight = weights_[slice.target]; weight != 0)
      kernel::add_scaled(offsets_.data() + slice.offsets, 3 * std::size_t{slice.end - slice.first}, weight,
                         coordinates.data() + 3 * std::size_t{slice.first - first});
}

void Morphed_points::pose_all(std::span<double> coordinates) const {
  constexpr std::size_t size = 3 * std::size_t{block_vertices};
  for (std::uint32_t block = 0; block < block_count(); ++block)
    pose_block(block, coordinates.subspan(block * size, std::min(size, coordinates.size() - block * size)));
}

}  // namespace lodestone
