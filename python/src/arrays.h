// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "integers.h"
#include "lodestone/mesh/coordinates.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/mesh/mesh_numbering.h"

/// Between numpy arrays and the types of the library.
namespace lodestone::python {

namespace py = pybind11;

/// An array of shape (V, 3) that Python code keeps, read where it is.
///
/// An array of float64 or float32, whatever its strides, is read by every query, so what is written into it counts. Of
/// anything else a copy is made. C-contiguous float64 needs no copy at all.
class Live_vertices {
 public:
  /// With the GIL.
  /// @throws Bad_mesh  not of shape (V, 3), no numbers
  explicit Live_vertices(const py::object& vertices);

  std::size_t count() const { return count_; }
  /// Notices an array that has other memory than when it was given. Without the GIL. O(1).
  /// @throws Bad_mesh
  void check_memory() const;
  /// Reads the array, unless it lies in memory as it is needed. Without the GIL. O(V) or O(1).
  void refresh();
  /// Where the vertices were at the last `refresh`, or are now.
  Coordinates coordinates() const { return direct_ != nullptr ? Coordinates(direct_, 3 * count_) : Coordinates(copy_); }

 private:
  template <class Number>
  void copy_from();

  py::array array_;
  std::size_t count_ = 0;
  const double* direct_ = nullptr;  ///< null: `copy_` is used
  bool is_float_ = false;
  const char* data_ = nullptr;
  py::ssize_t row_ = 0, column_ = 0;  ///< bytes from one to the next
  std::vector<double> copy_;
};

/// Faces from an array of shape (F, 3) of integers.
/// @throws Bad_mesh  another shape, no integers, a negative index or one of 2^32 or more
std::vector<Corners> faces_of(const py::object& faces);
/// The same of a surface, which has at least one.
/// @throws Bad_mesh  also if there is none
std::vector<Corners> surface_of(const py::object& faces);

/// One index per vertex, from an array of shape (V,) of integers.
/// @param name           of the argument, for the message
/// @throws Bad_argument  as faces_of
std::vector<std::uint32_t> indices_of(const py::object& indices, const std::string& name);

/// Numbers from an array-like of any shape, in C order.
/// @throws Bad_argument  no numbers
py::array_t<double, py::array::c_style> numbers_of(const py::object& numbers, const std::string& name);
/// Rows of three numbers: shape (n, 3).
py::array_t<double, py::array::c_style> rows_of(const py::object& rows, const std::string& name);
/// The same; an empty list has no rows.
py::array_t<double, py::array::c_style> rows_or_none_of(const py::object& rows, const std::string& name);
/// A matrix (4, 4) of finite numbers whose last row is 0, 0, 0, 1.
/// @throws Bad_argument  it is not; tells the name
Eigen::Matrix4d matrix_of(const py::object& matrix, const std::string& name);
/// Three numbers.
std::array<double, 3> vector_of(const py::object& vector, const std::string& name);

/// The vertices and faces that an argument gives: two arrays, an object with `vertices` and `faces`, or a pair of the two.
struct Given_mesh {
  py::object vertices, faces;
};
/// @param faces  None: `mesh` has both
/// @throws Bad_argument  it has not
Given_mesh given_mesh(const py::object& mesh, const py::object& faces, const std::string& name);

/// What `make` returns. Puts the name of the mesh before the message of a Bad_mesh or Bad_argument, unless it is empty.
template <class Make>
auto naming_mesh(const std::string& name, const Make& make) {
  try {
    return make();
  } catch (const Bad_mesh& error) {
    throw Bad_mesh(name.empty() ? error.what() : name + ": " + error.what());
  } catch (const Bad_argument& error) {
    throw Bad_argument(name.empty() ? error.what() : name + ": " + error.what());
  }
}

/// A new array of a list of plain numbers.
template <class Number, class List>
py::array_t<Number> array_of(const List& list) {
  py::array_t<Number> array(static_cast<py::ssize_t>(list.size()));
  std::copy(list.begin(), list.end(), array.mutable_data());
  return array;
}
/// A point as an array of shape (3,).
inline py::array_t<double> point_array(const Point& p) { return array_of<double>(std::array{p.x(), p.y(), p.z()}); }
/// Positions as an array of shape (V, 3).
py::array_t<double> positions_array(Coordinates coordinates);
/// Faces as an array of shape (F, 3).
py::array_t<std::int64_t> faces_array(std::span<const Corners> faces);

}  // namespace lodestone::python
