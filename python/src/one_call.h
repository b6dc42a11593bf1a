// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string>

#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/queries/closest_faces.h"
#include "lodestone/queries/impact_search.h"

/// The functions of the module that keep nothing.
namespace lodestone::python {

namespace py = pybind11;

/// The closest faces of two objects, by name.
py::dict closest_fields(const Closest_faces& closest);

/// The first impact of two objects, by name; None if there is none.
py::object impact_fields(const std::optional<Impact>& impact);

/// Positions from an array-like of shape (V, 3).
/// @throws Bad_argument  no numbers, another shape
Positions positions_of(const py::object& positions, const std::string& name);

void add_one_call(py::module_& module);

}  // namespace lodestone::python
