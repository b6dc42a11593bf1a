// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "integers.h"
#include "lodestone/detection/frame.h"

/// What a frame brought, for Python: a copy of the library's, which lasts until the next frame only.
namespace lodestone::python {

namespace py = pybind11;

/// A frame. Arrays are made when they are first asked for.
struct Python_frame {
  std::shared_ptr<const Frame> frame = {};
  bool with_points = false, with_normals = false;  ///< whether these were asked for
  py::object detector = py::none();                ///< that made it; None: a function
  std::uint64_t poses = 0;                         ///< of the detector, when it was made
};

/// One object pair of a frame. Its arrays are slices of the frame's.
struct Python_pair {
  py::object frame;  ///< a Python_frame
  Pair_result result;
};

/// The only pair of a frame, for functions about two objects; one without contacts if the frame has none.
py::object only_pair(Python_frame frame);

/// `Frame_statistics` by name.
py::dict statistics_of(const Frame_statistics& statistics);

void add_frames(py::module_& module);

}  // namespace lodestone::python
