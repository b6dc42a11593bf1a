// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "lodestone/mesh/morphed_points.h"

namespace lodestone {

/// Which joints move each vertex, and how much.
struct Joint_influences {
  std::vector<std::uint32_t> begin = {0};  ///< V + 1: where the list of each vertex starts, and past the last
  std::vector<std::uint32_t> joints = {};  ///< from 0
  std::vector<double> weights = {};        ///< of each joint; finite, >= 0, with a sum above 0 for each vertex

  /// The same number of joints for each vertex, as files have them. Those of weight 0 are left out.
  /// @param per_vertex        > 0
  /// @param joints, weights   `per_vertex` V
  /// @throws Bad_argument     lists of other lengths
  static Joint_influences of(std::size_t per_vertex, std::span<const std::uint32_t> joints,
                             std::span<const double> weights);
};

/// Linear blend skinning: (sum_j w_ij T_j) x_i, where x_i is vertex i at rest or morphed, T_j the motion of joint j and
/// w_ij its weight; the weights of a vertex are normalised to a sum of 1.
///
/// With M = sum_j w_ij T_j, summed in the order of the joints' list, and its columns m_x, m_y, m_z and m_t, a position
/// is (m_x x + m_z z) + (m_y y + m_t). Each product and each sum is rounded. A model of Computed_points.
class Skinned_points {
 public:
  /// All joints are at rest at first: T_j is the identity.
  /// @param rest           3 V coordinates, finite
  /// @param joint_count    > 0
  /// @throws Bad_argument  lists of other lengths than the number of vertices asks for, a joint that does not exist,
  ///                       a weight that is negative or not finite, a vertex whose weights do not have a positive sum
  Skinned_points(std::vector<double> rest, const Joint_influences& influences, std::size_t joint_count)
      : Skinned_points(Morphed_points(std::move(rest)), influences, joint_count) {}
  /// Vertices are morphed first, then skinned, as glTF has it.
  Skinned_points(Morphed_points shape, const Joint_influences& influences, std::size_t joint_count);

  /// Changes the pose. O(joints).
  /// @param joints         per joint: from where the shape is to where the joint takes it; finite
  /// @throws Bad_argument  the pose stays as it was
  void set_joints(std::span<const Eigen::Affine3d> joints);
  /// Changes the pose: see `Morphed_points::set_weights`.
  void set_weights(std::span<const double> weights) { shape_.set_weights(weights); }

  /// Number of vertices, V.
  std::uint32_t vertex_count() const { return shape_.vertex_count(); }
  /// Number of joints.
  std::size_t joint_count() const { return columns_.size() / 16; }
  /// Above 0; grows whenever the pose changes.
  std::uint64_t pose_number() const { return pose_number_ + shape_.pose_number(); }
  /// Grows when other points are assigned: see Computed_points.
  std::uint64_t shape_number() const { return pose_number_.assignments() + shape_.shape_number(); }
  /// What the joints move: the vertices at rest, or morphed.
  const Morphed_points& shape() const { return shape_; }
  /// The joints that move a vertex, and their normalised weights, all above 0.
  struct Influences {
    std::span<const std::uint32_t> joints;  ///< joint indices, in the order of the list
    std::span<const double> weights;        ///< of each, with a sum of 1 up to rounding
  };
  /// What moves a vertex. O(1).
  Influences influences(std::uint32_t vertex) const {
    const std::size_t begin = begin_[vertex], count = begin_[vertex + 1] - begin;
    return {std::span(joints_).subspan(begin, count), std::span(weights_).subspan(begin, count)};
  }
  /// The columns of the motion of a joint, each padded to four numbers.
  const double* columns(std::uint32_t joint) const { return columns_.data() + 16 * std::size_t{joint}; }

  /// One position. O(its joints).
  Eigen::Vector3d operator()(std::uint32_t vertex) const;
  /// The positions of a list.
  /// @param vertices     none twice
  /// @param coordinates  3 V; only those of the list are written
  void pose(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const;
  /// All positions.
  /// @param coordinates  3 V
  void pose_all(std::span<double> coordinates) const;

 private:
  Morphed_points shape_;
  std::vector<std::uint32_t> begin_;  ///< as in Joint_influences
  std::vector<std::uint32_t> joints_;
  std::vector<double> weights_;
  std::vector<double> columns_;  ///< per joint: the columns of T_j, each padded to four numbers
  Pose_number pose_number_;
};

}  // namespace lodestone
