// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "deadlock_mutex.h"
#include "gil.h"
#include "integers.h"
#include "lodestone/detection/detector_options.h"
#include "lodestone/io/motion/animation.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/skinned_points.h"

/// Surfaces that move by themselves: animations from files, and skins.
namespace lodestone::python {

namespace py = pybind11;

/// An animation from a file, or an object of a scene.
struct Python_animation {
  std::string name;
  std::shared_ptr<const Animation> animation;
  std::size_t frames = 1;  ///< of the scene, where the motion does not end by itself
  Object_options options = {};  ///< what its scene says of it

  /// The frame that a number means: -1 is the last. Nothing if there is no such frame.
  std::optional<std::size_t> frame_of(py::ssize_t number) const;
  /// For an error: that there is none.
  std::string no_frame(py::ssize_t number) const;
  /// Positions of a frame. Without the GIL.
  /// @throws Bad_argument, Bad_motion
  std::vector<double> pose(std::size_t frame) const;
};

/// Joints and morph targets that move vertices. A change of the pose waits until no query reads it.
class Python_skin {
 public:
  explicit Python_skin(Skinned_points points) : points_(std::move(points)) {}

  const Skinned_points& points() const { return points_; }
  /// All positions. Without the GIL.
  std::vector<double> pose() const;
  /// Grows with every change of the pose. Without the GIL.
  std::uint64_t pose_number() const {
    const std::lock_guard lock(mutex_);
    return points_.pose_number();
  }
  /// Changes the pose. Without the GIL.
  /// @throws Bad_argument  a visitor calls, whose query reads the pose
  template <class Change>
  void change(const Change& change) {
    const std::lock_guard lock(mutex_);
    if (readers_ > 0) throw Bad_argument("a visitor changed a skin that its detector reads");
    change(points_);
  }

  /// While a query reads the pose.
  class Reading {
   public:
    explicit Reading(Python_skin& skin) : skin_(skin), lock_(skin.mutex_) { ++skin_.readers_; }
    ~Reading() { --skin_.readers_; }
    Reading(const Reading&) = delete;

   private:
    Python_skin& skin_;
    std::unique_lock<Deadlock_mutex> lock_;
  };

 private:
  Skinned_points points_;
  mutable Deadlock_mutex mutex_;  ///< a visitor may look at the pose, and ask other detectors
  int readers_ = 0;               ///< queries of the thread that holds the mutex
};

void add_motions(py::module_& module);

}  // namespace lodestone::python
