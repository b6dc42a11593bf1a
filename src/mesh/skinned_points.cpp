// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/skinned_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lodestone/mesh/errors.h"
#include "mesh/pose_kernel.h"

namespace lodestone {

namespace {

void check(const Joint_influences& influences, std::size_t vertex_count, std::size_t joint_count) {
  const auto& [begin, joints, weights] = influences;
  if (begin.size() != vertex_count + 1 || begin.front() != 0 || !std::ranges::is_sorted(begin) ||
      begin.back() != joints.size() || joints.size() != weights.size())
    throw Bad_argument(fmt::format("the lists of joints and weights do not fit {} vertices", vertex_count));
  for (std::size_t vertex = 0; vertex < vertex_count; ++vertex) {
    double sum = 0;
    for (std::size_t i = begin[vertex]; i < begin[vertex + 1]; ++i) {
      if (joints[i] >= joint_count)
        throw Bad_argument(fmt::format("vertex {} follows joint {} of {}", vertex, joints[i], joint_count));
      if (!(weights[i] >= 0) || !std::isfinite(weights[i]))
        throw Bad_argument(
            fmt::format("vertex {} has the weight {} of a joint, must be >= 0 and finite", vertex, weights[i]));
      sum += weights[i];
    }
    if (!(sum > 0) || !std::isfinite(sum))
      throw Bad_argument(fmt::format("the weights of vertex {} have the sum {}, must be > 0 and finite", vertex, sum));
  }
}

}  // namespace

Joint_influences Joint_influences::of(std::size_t per_vertex, std::span<const std::uint32_t> joints,
                                      std::span<const double> weights) {
  if (per_vertex == 0 || joints.size() != weights.size() || joints.size() % per_vertex != 0)
    throw Bad_argument(fmt::format("{} joints and {} weights, expected {} of both for each vertex", joints.size(),
                                   weights.size(), per_vertex));
  Joint_influences influences;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (weights[i] != 0) {
      influences.joints.push_back(joints[i]);
      influences.weights.push_back(weights[i]);
    }
    if ((i + 1) % per_vertex == 0) influences.begin.push_back(static_cast<std::uint32_t>(influences.joints.size()));
  }
  return influences;
}

Skinned_points::Skinned_points(Morphed_points shape, const Joint_influences& influences, std::size_t joint_count)
    : shape_(std::move(shape)) {
  check(influences, vertex_count(), joint_count);
  begin_.push_back(0);
  for (std::size_t vertex = 0; vertex < vertex_count(); ++vertex) {
    double sum = 0;
    for (std::size_t i = influences.begin[vertex]; i < influences.begin[vertex + 1]; ++i) sum += influences.weights[i];
    for (std::size_t i = influences.begin[vertex]; i < influences.begin[vertex + 1]; ++i) {
      if (influences.weights[i] == 0) continue;
      joints_.push_back(influences.joints[i]);
      weights_.push_back(influences.weights[i] / sum);
    }
    begin_.push_back(static_cast<std::uint32_t>(joints_.size()));
  }
  columns_.resize(16 * joint_count);
  set_joints(std::vector<Eigen::Affine3d>(joint_count, Eigen::Affine3d::Identity()));
}

void Skinned_points::set_joints(std::span<const Eigen::Affine3d> joints) {
  if (joints.size() != joint_count())
    throw Bad_argument(fmt::format("the motions of {} joints for a skin of {}", joints.size(), joint_count()));
  for (std::size_t joint = 0; joint < joints.size(); ++joint)
    if (!joints[joint].affine().allFinite())
      throw Bad_argument(fmt::format("the motion of joint {} has a number that is not finite", joint));
  for (std::size_t joint = 0; joint < joints.size(); ++joint) {
    Eigen::Map<Eigen::Matrix4d> columns(columns_.data() + 16 * joint);
    columns.setZero();
    columns.topRows<3>() = joints[joint].affine();
  }
  ++pose_number_;
}

Eigen::Vector3d Skinned_points::operator()(std::uint32_t vertex) const {
  const Eigen::Vector3d shape = shape_(vertex);
  Eigen::Vector3d position;
  // The tables of this vertex alone: it is vertex 0 of them.
  kernel::skin({begin_.data() + vertex, joints_.data(), weights_.data(), columns_.data()}, nullptr, 1, shape.data(),
               position.data());
  return position;
}

void Skinned_points::pose(std::span<const std::uint32_t> vertices, std::span<double> coordinates) const {
  const bool morphed = shape_.target_count() > 0;
  if (morphed) shape_.pose(vertices, coordinates);
  kernel::skin({begin_.data(), joints_.data(), weights_.data(), columns_.data()}, vertices.data(), vertices.size(),
               morphed ? coordinates.data() : shape_.rest().data(), coordinates.data());
}

void Skinned_points::pose_all(std::span<double> coordinates) const {
  const kernel::Skin skin{begin_.data(), joints_.data(), weights_.data(), columns_.data()};
  if (shape_.target_count() == 0)
    return kernel::skin(skin, nullptr, vertex_count(), shape_.rest().data(), coordinates.data());
  // Block by block, so that what is morphed is still in the cache when it is skinned.
  std::array<double, 3 * std::size_t{Morphed_points::block_vertices}> morphed;
  for (std::uint32_t block = 0; block < shape_.block_count(); ++block) {
    const std::uint32_t first = block * Morphed_points::block_vertices;
    const std::uint32_t count = std::min(Morphed_points::block_vertices, vertex_count() - first);
    shape_.pose_block(block, std::span(morphed).first(3 * std::size_t{count}));
    kernel::skin({skin.begin + first, skin.joints, skin.weights, skin.columns}, nullptr, count, morphed.data(),
                 coordinates.data() + 3 * std::size_t{first});
  }
}

}  // namespace lodestone
