// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "lodestone/mesh/coordinates.h"
#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/mesh/workers.h"

namespace lodestone {

/// Coordinates as floats relative to a box: good enough to group faces, and half as large.
class Float_frame {
 public:
  /// Relative to the box around all positions.
  Float_frame(Coordinates coordinates, Workers& workers) : coordinates_(coordinates) {
    constexpr std::size_t at_once = 3 * 16384;  // a worker takes so many
    std::vector<Eigen::AlignedBox3d> boxes(coordinates.size() / at_once + 1);
    workers.run(boxes.size(), [&](std::size_t index, std::size_t) {
      const std::size_t end = std::min((index + 1) * at_once, coordinates.size());
      for (std::size_t i = index * at_once; i < end; i += 3)
        boxes[index].extend(Eigen::Map<const Eigen::Vector3d>(coordinates.data() + i));
    });
    for (const auto& box : boxes) boxes.front().extend(box);
    place(boxes.front());
  }
  /// Relative to the box around some faces.
  Float_frame(Coordinates coordinates, std::span<const Corners> corners, std::span<const std::uint32_t> faces)
      : coordinates_(coordinates) {
    Eigen::AlignedBox3d box;
    for (const auto face : faces)
      for (const auto vertex : corners[face]) box.extend(Eigen::Map<const Eigen::Vector3d>(position(vertex)));
    place(box);
  }

  /// The mean of a face's corners, each component in [-1, 1].
  std::array<float, 3> mean(const Corners& corners) const {
    const double *a = position(corners[0]), *b = position(corners[1]), *c = position(corners[2]);
    constexpr double sixth = 1.0 / 6;
    std::array<float, 3> mean;
    for (int axis = 0; axis < 3; ++axis) {
      const double half = a[axis] * sixth + b[axis] * sixth + c[axis] * sixth;
      mean[static_cast<std::size_t>(axis)] = static_cast<float>((half - half_middle_[axis]) * scale_);
    }
    return mean;
  }

 private:
  void place(const Eigen::AlignedBox3d& box) {
    // Halved, since sums and differences may overflow.
    half_middle_ = box.min() / 4 + box.max() / 4;
    const double half_width = (box.max() / 2 - box.min() / 2).maxCoeff();
    scale_ = std::min(2 / half_width, std::numeric_limits<double>::max());
  }
  const double* position(std::uint32_t vertex) const { return coordinates_.data() + 3 * std::size_t{vertex}; }

  Coordinates coordinates_;
  Eigen::Vector3d half_middle_;
  double scale_;
};

}  // namespace lodestone
