// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "detector.h"

/// The class Detector of the module, and the methods that have files of their own.
namespace lodestone::python {

using Detector_class = py::class_<Python_detector, std::shared_ptr<Python_detector>>;

/// When objects first meet.
void add_impacts(Detector_class& type);
/// Many and single rays and points.
void add_rays_and_points(Detector_class& type);
/// The classes of promises.
void add_promises(py::module_& module);
/// The method that takes one.
void add_promise(Detector_class& type);

}  // namespace lodestone::python
