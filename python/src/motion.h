// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "lodestone/detection/collision_groups.h"
#include "lodestone/io/motion/animation.h"
#include "lodestone/mesh/skinned_points.h"

/// Surfaces that move by themselves: animations from files, and skins.
namespace lodestone::python {

namespace py = pybind11;

/// An animation from a file, or an object of a scene.
struct Python_animation {
  std::string name;
  std::shared_ptr<const Animation> animation;
  std::size_t frames = 1;  ///< of the scene, where the motion does not end by itself
  Collision_groups groups = {};

  /// Positions of a frame. Without the GIL.
  /// @throws Bad_argument, Bad_motion
  std::vector<double> pose(std::size_t frame) const;
};

/// Joints and morph targets that move vertices. A change of the pose waits until no query reads it.
struct Python_skin {
  Python_skin(Skinned_points skinned) : points(std::move(skinned)) {}

  std::vector<double> pose() const;

  Skinned_points points;
  mutable std::mutex in_use;
};

void add_motions(py::module_& module);

}  // namespace lodestone::python
