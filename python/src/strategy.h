// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

#include "integers.h"
#include "lodestone/partition/strategies.h"

namespace lodestone::python {

namespace py = pybind11;

/// A partition strategy that Python names, or has as a function.
struct Given_strategy {
  std::string name = "lbg";                      ///< one of the library's; or of the function
  std::shared_ptr<const py::function> function;  ///< null: one of the library's. Released with the GIL

  /// @throws Bad_argument  the library has none of that name
  Any_strategy make(const Strategy_settings& settings) const;
};

/// A function is called with the vertices (V, 3), the faces (F, 3) and a number of regions, and returns labels (V,).
/// @throws TypeError  neither a text nor callable
Given_strategy given_strategy(const py::handle& strategy);

}  // namespace lodestone::python
