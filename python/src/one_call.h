// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include "lodestone/queries/closest_faces.h"

/// The functions of the module that keep nothing.
namespace lodestone::python {

namespace py = pybind11;

/// The closest faces of two objects, by name.
py::dict closest_fields(const Closest_faces& closest);

void add_one_call(py::module_& module);

}  // namespace lodestone::python
