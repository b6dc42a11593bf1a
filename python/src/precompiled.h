// SPDX-License-Identifier: GPL-3.0-or-later
// The slow headers, compiled once.
#pragma once

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "integers.h"
#include "lodestone/detector.h"
