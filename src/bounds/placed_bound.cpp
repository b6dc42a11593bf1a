// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/bounds/placed_bound.h"

#include <array>
#include <cmath>

#include "bounds/node_lists.h"

namespace lodestone {

Aabb placed_box(const Eigen::Matrix3d& linear, const Eigen::Vector3d& translation, const Aabb& box) {
  std::array<double, 3> centre, half;
  for (std::size_t j = 0; j < 3; ++j) {
    centre[j] = box.low[j] / 2 + box.high[j] / 2;
    half[j] = box.high[j] / 2 - box.low[j] / 2;
  }
  Aabb placed{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    double middle = translation[row], reach = 0, magnitude = std::abs(middle);
    for (std::size_t j = 0; j < 3; ++j) {
      const double factor = linear(row, static_cast<Eigen::Index>(j));
      middle += factor * centre[j];
      reach += std::abs(factor) * half[j];
      magnitude += std::abs(factor) * (std::abs(centre[j]) + half[j]);
    }
    const double margin = 32 * unit_roundoff * magnitude + 0x1p-1060;
    placed.low[i] = middle - reach - margin;
    placed.high[i] = middle + reach + margin;
    open_if_not_finite(placed, i);
  }
  return placed;
}

Aabb Placed_bound::box(std::uint32_t node, std::vector<Eigen::Vector3d>& read) const {
  const std::size_t before = read.size();
  const Aabb in_mesh = bound_->box(node, read);
  if (*placement_)
    for (auto& position : std::span(read).subspan(before)) position = (**placement_)(position);
  return placed(in_mesh);
}

bool Placed_bound::note_read(std::uint32_t leaf, const Aabb& fitted, Coordinates coordinates) {
  if (*given_) return true;
  if (!*placement_) return bound_->note_read(leaf, fitted, coordinates);
  if (!bound_->watches()) return true;
  Coordinates in_mesh = positions_->in_memory();
  if (in_mesh.empty()) {
    in_mesh_.resize(coordinates.size());
    positions_->pose(layout_->vertices(leaf), in_mesh_);
    in_mesh = in_mesh_;
  }
  Aabb box;
  box.enclose(layout_->leaf_faces(leaf, in_mesh));
  return bound_->note_read(leaf, box, in_mesh);
}

}  // namespace lodestone
