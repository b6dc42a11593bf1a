// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include "frame.h"
#include "partition.h"

/// What functions found, as bytes and back: for `pickle`, `copy` and other processes.
namespace lodestone::python {

/// A frame without its detector, as bytes. O(contacts).
py::bytes pickled(const Python_frame& frame);
/// A partition, as bytes. O(V).
py::bytes pickled(const Python_partition& partition);

/// What `pickled` has made of a frame.
/// @throws Bad_saved_object  the bytes are of something else, or written by another version of this package in
///                           another way
Python_frame unpickled_frame(const py::bytes& bytes);
/// The same of a partition.
Python_partition unpickled_partition(const py::bytes& bytes);

}  // namespace lodestone::python
