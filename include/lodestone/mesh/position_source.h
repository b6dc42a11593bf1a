// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "lodestone/mesh/computed_points.h"
#include "lodestone/mesh/coordinates.h"

namespace lodestone {

/// The current positions of V vertices, computed or read when they are asked for: Computed_points, or a mesh, behind
/// one interface.
class Position_source {
 public:
  virtual ~Position_source() = default;

  /// Number of vertices, V.
  virtual std::uint32_t vertex_count() const = 0;
  /// Grows whenever positions change; 0: unknown, so they are read anew.
  virtual std::uint64_t pose_number() const = 0;
  /// One position.
  virtual Eigen::Vector3d operator()(std::uint32_t vertex) const = 0;
  /// Those of a list, in which no vertex stands twice.
  /// @param coordinates  3 V; only those of the list are written
  virtual void pose(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const = 0;
  /// All of them.
  /// @param coordinates  3 V, written
  virtual void pose_all(std::span<double> coordinates) const = 0;
  /// All of them, if they lie in memory; empty: they must be computed. O(1).
  /// @return valid as long as the pose number stays; if that is 0, until the next look
  virtual Coordinates in_memory() const { return {}; }
  /// All of them, where they lie in memory already.
  /// @param memory  3 V: written if they do not
  /// @return where they are: in that memory, or in that of a mesh
  virtual Coordinates all(std::span<double> memory) const {
    pose_all(memory);
    return memory;
  }
};

/// Computed points as a Position_source.
template <Computed_points Points>
class Computed_source final : public Position_source {
 public:
  /// @param points  must outlive this
  explicit Computed_source(const Points& points) : points_(&points) {}

  std::uint32_t vertex_count() const override { return points_->vertex_count(); }
  std::uint64_t pose_number() const override { return points_->pose_number(); }
  Eigen::Vector3d operator()(std::uint32_t vertex) const override { return (*points_)(vertex); }
  void pose(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const override {
    points_->pose(vertices, coordinates);
  }
  void pose_all(std::span<double> coordinates) const override { points_->pose_all(coordinates); }

 private:
  const Points* points_;
};

}  // namespace lodestone
