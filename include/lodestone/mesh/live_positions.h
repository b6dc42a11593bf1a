// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "lodestone/mesh/rigid_motion.h"

namespace lodestone {

/// Reads where single vertices of an object are now, by vertex index.
class Live_positions {
 public:
  /// Computes, or looks up, the position of one vertex of a mesh.
  using Read = Eigen::Vector3d (*)(const void* mesh, std::uint32_t vertex);

  Live_positions() = default;
  /// Reads positions that lie in memory.
  /// @param memory     x, y, z of vertex 0, then of vertex 1 and so on; must outlive this
  /// @param placement  none: vertices are where the memory has them
  explicit Live_positions(const double* memory, const std::optional<Rigid_motion>& placement = {})
      : memory_(memory), placement_(placement) {}
  /// Reads positions through a function.
  /// @param mesh  given to `read`; must outlive this
  Live_positions(const void* mesh, Read read, const std::optional<Rigid_motion>& placement = {})
      : mesh_(mesh), read_(read), placement_(placement) {}

  /// All positions, if they lie in memory as they are; null: each is to be read, or placed.
  const double* memory() const { return placement_ ? nullptr : memory_; }

  /// Whether several threads may read at once: what a mesh computes may not allow it.
  bool is_shared() const { return memory_ != nullptr; }

  /// Where a vertex is now, placement included.
  Eigen::Vector3d operator()(std::uint32_t vertex) const {
    const Eigen::Vector3d position = memory_ != nullptr
                                         ? Eigen::Map<const Eigen::Vector3d>(memory_ + 3 * std::size_t{vertex})
                                         : read_(mesh_, vertex);
    return placement_ ? (*placement_)(position) : position;
  }

 private:
  const double* memory_ = nullptr;  ///< null: read through the mesh
  const void* mesh_ = nullptr;
  Read read_ = nullptr;
  std::optional<Rigid_motion> placement_;
};

}  // namespace lodestone
