// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "lodestone/detection/watched_mesh.h"
#include "lodestone/mesh/rigid_motion.h"

namespace lodestone {

/// Reads where single vertices of an object are now, by vertex index.
class Live_positions {
 public:
  Live_positions() = default;
  /// Valid until the mesh gets other vertices. The mesh must outlive this.
  Live_positions(Watched_mesh& mesh, const std::optional<Rigid_motion>& placement)
      : memory_(mesh.in_memory() ? mesh.read().data() : nullptr),
        mesh_(&mesh),
        placement_(placement) {}

  Eigen::Vector3d operator()(std::uint32_t vertex) const {
    const Eigen::Vector3d position =
        memory_ != nullptr ? Eigen::Map<const Eigen::Vector3d>(memory_ + 3 * std::size_t{vertex}) : mesh_->read(vertex);
    return placement_ ? (*placement_)(position) : position;
  }

 private:
  const double* memory_ = nullptr;  ///< null: read through the mesh, one vertex at a time
  const Watched_mesh* mesh_ = nullptr;
  std::optional<Rigid_motion> placement_;  ///< none: where the mesh has them
};

}  // namespace lodestone
