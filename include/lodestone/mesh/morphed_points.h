// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/pose_number.h"

namespace lodestone {

/// A shape that vertices move towards.
struct Morph_target {
  std::vector<std::uint32_t> vertices = {};  ///< those that it moves, ascending; empty: all, in order
  std::vector<double> offsets = {};          ///< of each: x, y, z at weight 1; finite. Empty: it moves nothing
};

/// Morph targets: x_i + sum_j q_j U_ij, where x_i is vertex i at rest, q_j the weight of target j and U_ij its offset.
///
/// The sum is taken target by target, in order; each product and each sum is rounded. Targets of weight 0 are left out.
/// A model of Computed_points. Targets that move few vertices cost as little as they move.
class Morphed_points {
 public:
  /// All weights are 0 at first.
  /// @param rest           3 V coordinates, finite
  /// @throws Bad_argument  a number that is not finite, a list of the wrong length, a vertex that does not exist, or
  ///                       vertices that do not ascend
  explicit Morphed_points(std::vector<double> rest, std::span<const Morph_target> targets = {});

  /// Changes the pose. O(targets).
  /// @param weights        per target; finite
  /// @throws Bad_argument  the pose stays as it was
  void set_weights(std::span<const double> weights);

  /// Number of vertices, V.
  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(rest_.size() / 3); }
  /// Number of morph targets.
  std::size_t target_count() const { return weights_.size(); }
  /// Above 0; grows whenever the pose changes.
  std::uint64_t pose_number() const { return pose_number_; }
  /// Grows when other points are assigned: see Computed_points.
  std::uint64_t shape_number() const { return pose_number_.assignments(); }
  /// 3 V coordinates.
  std::span<const double> rest() const { return rest_; }
  /// Per target.
  std::span<const double> weights() const { return weights_; }

  /// Calls `use(target, offset)` for the targets that may move a vertex, in order. Offsets may be 0.
  template <class Use>
  void for_each_offset(std::uint32_t vertex, Use use) const {
    for (const Slice& slice : slices_of(vertex))
      if (vertex >= slice.first && vertex < slice.end)
        use(slice.target, std::span<const double, 3>(offsets_.data() + slice.offsets + 3 * (vertex - slice.first), 3));
  }

  /// One position. O(targets that move vertices near it).
  Eigen::Vector3d operator()(std::uint32_t vertex) const;
  /// The positions of a list.
  /// @param coordinates  3 V; only those of the list are written
  void pose(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const;
  /// All positions.
  /// @param coordinates  3 V
  void pose_all(std::span<double> coordinates) const;

  /// Consecutive vertices whose offsets lie together. Targets that move none of a block take no time there.
  static constexpr std::uint32_t block_vertices = 64;
  /// Number of blocks; the last may have fewer vertices.
  std::uint32_t block_count() const { return (vertex_count() + block_vertices - 1) / block_vertices; }
  /// The positions of one block.
  /// @param coordinates  three for each of its vertices: `block_vertices`, or what is left of all in the last block
  void pose_block(std::uint32_t block, std::span<double> coordinates) const;

 private:
  /// What one target adds to consecutive vertices of one block.
  struct Slice {
    std::uint32_t target;
    std::uint32_t first, end;  ///< vertices
    std::uint64_t offsets;     ///< where they start in `offsets_`
  };
  std::span<const Slice> slices_of(std::uint32_t vertex) const;
  void add_slices(std::uint32_t block, std::span<const Morph_target> targets, std::vector<std::size_t>& next);

  std::vector<double> rest_;
  std::vector<Slice> slices_;               ///< by block, then by target
  std::vector<std::uint64_t> slice_begin_;  ///< per block and past the last
  std::vector<double> offsets_;
  std::vector<double> weights_;
  Pose_number pose_number_;
};

}  // namespace lodestone
