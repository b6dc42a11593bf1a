// SPDX-License-Identifier: GPL-3.0-or-later
// What compare.py measures the Python package against: the same calls, in C++, on a CGAL::Surface_mesh.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <chrono>
#include <deque>

#include "lodestone/find_collisions.h"

namespace lodestone {

namespace {

namespace py = pybind11;
using Array = py::array_t<double, py::array::c_style>;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

Surface_mesh mesh_of(const Array& vertices, const py::array_t<std::int64_t, py::array::c_style>& faces) {
  Surface_mesh mesh;
  for (py::ssize_t v = 0; v < vertices.shape(0); ++v)
    mesh.add_vertex(Point(vertices.at(v, 0), vertices.at(v, 1), vertices.at(v, 2)));
  for (py::ssize_t f = 0; f < faces.shape(0); ++f)
    mesh.add_face(Surface_mesh::Vertex_index(static_cast<std::uint32_t>(faces.at(f, 0))),
                  Surface_mesh::Vertex_index(static_cast<std::uint32_t>(faces.at(f, 1))),
                  Surface_mesh::Vertex_index(static_cast<std::uint32_t>(faces.at(f, 2))));
  return mesh;
}

/// A detector of meshes, as a C++ program has it.
class Baseline {
 public:
  explicit Baseline(bool yes_no) : options_{.contacts = yes_no ? Contact_query::yes_no : Contact_query::all} {}

  void add(const Array& vertices, const py::array_t<std::int64_t, py::array::c_style>& faces) {
    meshes_.push_back(mesh_of(vertices, faces));
  }
  /// Seconds to add both meshes and answer the first time.
  double build() {
    const auto start = Clock::now();
    detector_.emplace(options_);
    for (const auto& mesh : meshes_) detector_->add(mesh);
    contacts_ = detector_->detect().face_pairs.size();
    return seconds_since(start);
  }
  /// Seconds to move a mesh and answer. Vertices are written as Python writes them, in one piece.
  double frame(const Array& vertices) {
    const double* from = vertices.data();
    const auto size = static_cast<std::size_t>(vertices.size());
    const auto start = Clock::now();
    std::memcpy(static_cast<void*>(&meshes_.front().point(Surface_mesh::Vertex_index(0))), from, size * sizeof(double));
    contacts_ = detector_->detect().face_pairs.size();
    return seconds_since(start);
  }
  std::size_t contacts() const { return contacts_; }

 private:
  Detector_options options_;
  std::deque<Surface_mesh> meshes_;
  std::optional<Detector<>> detector_;
  std::size_t contacts_ = 0;
};

}  // namespace

}  // namespace lodestone

PYBIND11_MODULE(lodestone_baseline, module) {
  using lodestone::Baseline;
  pybind11::class_<Baseline>(module, "Baseline")
      .def(pybind11::init<bool>())
      .def("add", &Baseline::add)
      .def("build", &Baseline::build)
      .def("frame", &Baseline::frame)
      .def_property_readonly("contacts", &Baseline::contacts);
}
