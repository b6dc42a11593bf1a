// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <string>

/// Names and messages as text of Python's. Names of files, and names inside files, can be any bytes.
namespace lodestone::python {

namespace py = pybind11;

/// Bytes that are no UTF-8 are replaced.
inline py::str text_of(const std::string& text) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace"));
}

/// As Python's own functions give the names of files.
inline py::str name_of_file(const std::filesystem::path& path) {
  const std::string& name = path.native();
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeFSDefaultAndSize(name.data(), static_cast<py::ssize_t>(name.size())));
}

}  // namespace lodestone::python
