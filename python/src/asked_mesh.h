// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "detector.h"
#include "lodestone/mesh/errors.h"

namespace lodestone::python {

namespace py = pybind11;

/// A mesh that is asked about once.
struct Asked_mesh {
  Asked_mesh(const py::object& asked, const py::object& asked_faces, const std::string& name) try
      : given(given_mesh(asked, asked_faces, name)),
        faces(surface_of(given.faces)),
        vertices(given.vertices),
        mesh(vertices.coordinates(), faces) {
  } catch (const Bad_mesh& error) {
    throw Bad_mesh(name + ": " + error.what());
  }

  Given_mesh given;
  std::vector<Corners> faces;
  Live_vertices vertices;
  Indexed_mesh mesh;
};

}  // namespace lodestone::python
