// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include "lodestone/detection/detector_options.h"
#include "strategy.h"

/// Options from keyword arguments.
namespace lodestone::python {

namespace py = pybind11;

/// What a detector is made with.
struct Detector_settings {
  Detector_options options;
  Given_strategy strategy;
  Strategy_settings strategy_settings;
};

/// The names are those of `Detector_options` and `Exact_options`; those of LBG begin with `lbg_`.
/// @throws TypeError     an unknown name, a value of the wrong type
/// @throws Bad_argument  a value that is none of the choices
Detector_settings detector_settings(const py::kwargs& keywords);

/// What a partition is made with.
struct Partition_settings {
  Given_strategy strategy;
  Strategy_settings strategy_settings;
  Partition_options options;
};
Partition_settings partition_settings(const py::object& strategy, const py::kwargs& keywords);

}  // namespace lodestone::python
