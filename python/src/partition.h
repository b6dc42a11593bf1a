// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "lodestone/partition/partition.h"
#include "lodestone/partition/partition_measures.h"

namespace lodestone::python {

namespace py = pybind11;

/// What a partition is, with how good it is.
struct Python_partition {
  std::string strategy = {};
  Numbered_partition partition = {};
  Partition_measures measures = {};
};

void add_partitions(py::module_& module);

}  // namespace lodestone::python
