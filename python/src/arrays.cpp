// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.h"

#include <cstring>
#include <limits>
#include <sstream>

#include "lodestone/mesh/errors.h"

namespace lodestone::python {

namespace {

/// Such as `(5, 2)`.
std::string shape_of(const py::array& array) {
  std::ostringstream text;
  text << '(';
  for (py::ssize_t i = 0; i < array.ndim(); ++i) text << (i > 0 ? ", " : "") << array.shape(i);
  text << (array.ndim() == 1 ? ",)" : ")");
  return text.str();
}

/// The argument as an array; empty if numpy makes none of it.
/// @throws what else the argument raises when it is asked for its numbers
std::optional<py::array> array_from(const py::object& object) {
  if (py::isinstance<py::array>(object)) {
    if (py::hasattr(object, "filled"))  // a numpy.ma.MaskedArray
      throw py::type_error("a masked array has no numbers where it is masked: fill it first");
    return py::reinterpret_borrow<py::array>(object);
  }
  try {
    return py::module_::import("numpy").attr("asarray")(object).cast<py::array>();
  } catch (py::error_already_set& error) {
    if (error.matches(PyExc_ValueError) || error.matches(PyExc_TypeError)) return std::nullopt;
    throw;
  }
}

/// An attribute of an object; null if it has none.
/// @throws what else a property raises
py::object attribute_of(const py::object& object, const char* name) {
  auto value = py::reinterpret_steal<py::object>(PyObject_GetAttrString(object.ptr(), name));
  if (value) return value;
  if (PyErr_ExceptionMatches(PyExc_AttributeError) == 0) throw py::error_already_set();
  PyErr_Clear();
  return value;
}

bool has_numbers(const py::array& array) { return std::string("iufb").find(array.dtype().kind()) != std::string::npos; }
bool has_integers(const py::array& array) { return std::string("iu").find(array.dtype().kind()) != std::string::npos; }

bool is_aligned(const py::array& array) { return (array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_) != 0; }

/// Integers of any size as indices.
template <class Integer, class Fail>
void read_indices(const py::array& array, std::uint32_t* to, const Fail& fail) {
  const auto* from = static_cast<const Integer*>(array.data());
  for (py::ssize_t i = 0; i < array.size(); ++i) {
    // A negative number is beyond the limit, too.
    if (static_cast<std::uint64_t>(from[i]) > std::numeric_limits<std::uint32_t>::max())
      fail(i, std::to_string(from[i]));
    to[i] = static_cast<std::uint32_t>(from[i]);
  }
}

/// @param fail  called with the place and the text of an index out of range
template <class Fail>
void read_indices(const py::array& array, std::uint32_t* to, const Fail& fail) {
  if (const auto wide = py::array_t<std::int64_t, py::array::c_style>::ensure(array))
    return read_indices<std::int64_t>(wide, to, fail);
  read_indices<std::uint64_t>(py::array_t<std::uint64_t, py::array::c_style | py::array::forcecast>(array), to, fail);
}

}  // namespace

Live_vertices::Live_vertices(const py::object& vertices) {
  const auto array = array_from(vertices);
  if (!array || !has_numbers(*array)) throw Bad_mesh("vertices must be an array of numbers of shape (V, 3)");
  if (array->ndim() != 2 || array->shape(1) != 3)
    throw Bad_mesh("vertices must have the shape (V, 3), but have " + shape_of(*array));
  is_float_ = py::isinstance<py::array_t<float>>(*array);
  array_ = is_float_ || py::isinstance<py::array_t<double>>(*array)
               ? *array
               : py::array(py::array_t<double, py::array::c_style | py::array::forcecast>(*array));
  count_ = static_cast<std::size_t>(array_.shape(0));
  data_ = static_cast<const char*>(array_.data());
  row_ = array_.strides(0);
  column_ = array_.strides(1);
  if (!is_float_ && is_aligned(array_) && (array_.flags() & py::array::c_style) != 0)
    direct_ = reinterpret_cast<const double*>(data_);
  else
    refresh();
}

template <class Number>
void Live_vertices::copy_from() {
  copy_.resize(3 * count_);
  if (row_ == 3 * static_cast<py::ssize_t>(sizeof(Number)) && column_ == sizeof(Number) && is_aligned(array_)) {
    const auto* from = reinterpret_cast<const Number*>(data_);
    for (std::size_t i = 0; i < copy_.size(); ++i) copy_[i] = from[i];
    return;
  }
  for (std::size_t v = 0; v < count_; ++v)
    for (std::size_t i = 0; i < 3; ++i) {
      Number number;
      std::memcpy(&number, data_ + static_cast<py::ssize_t>(v) * row_ + static_cast<py::ssize_t>(i) * column_,
                  sizeof(Number));
      copy_[3 * v + i] = number;
    }
}

void Live_vertices::check_memory() const {
  if (array_.data() != data_ || array_.ndim() != 2 || static_cast<std::size_t>(array_.shape(0)) != count_ ||
      array_.strides(0) != row_ || array_.strides(1) != column_)
    throw Bad_mesh("the array of its vertices has been resized in place: give it anew, by set_vertices or rebuild");
}

void Live_vertices::refresh() {
  if (direct_ != nullptr) return;
  if (is_float_)
    copy_from<float>();
  else
    copy_from<double>();
}

std::vector<Corners> faces_of(const py::object& faces) {
  const auto array = array_from(faces);
  if (!array || (array->size() > 0 && !has_integers(*array)))
    throw Bad_mesh("faces must be an array of integers of shape (F, 3)");
  if (array->size() == 0) return {};
  if (array->ndim() != 2 || array->shape(1) != 3)
    throw Bad_mesh("faces must have the shape (F, 3), but have " + shape_of(*array));
  std::vector<Corners> corners(static_cast<std::size_t>(array->shape(0)));
  static_assert(sizeof(Corners) == 3 * sizeof(std::uint32_t));
  read_indices(*array, corners.front().data(), [](py::ssize_t place, const std::string& index) {
    throw Bad_mesh("face " + std::to_string(place / 3) + " refers to vertex " + index);
  });
  return corners;
}

std::vector<Corners> surface_of(const py::object& faces) {
  auto corners = faces_of(faces);
  if (corners.empty()) throw Bad_mesh("the mesh has no face");
  return corners;
}

std::vector<std::uint32_t> indices_of(const py::object& indices, const std::string& name) {
  const auto array = array_from(indices);
  if (!array || array->ndim() != 1 || (array->size() > 0 && !has_integers(*array)))
    throw Bad_argument(name + " must be a list of integers");
  std::vector<std::uint32_t> list(static_cast<std::size_t>(array->size()));
  if (list.empty()) return list;
  read_indices(*array, list.data(), [&](py::ssize_t place, const std::string& index) {
    throw Bad_argument(name + "[" + std::to_string(place) + "] is " + index);
  });
  return list;
}

py::array_t<double, py::array::c_style> numbers_of(const py::object& numbers, const std::string& name) {
  const auto array = array_from(numbers);
  if (!array || !has_numbers(*array)) throw Bad_argument(name + " must be numbers");
  return py::array_t<double, py::array::c_style | py::array::forcecast>(*array);
}

py::array_t<double, py::array::c_style> rows_of(const py::object& rows, const std::string& name) {
  auto array = numbers_of(rows, name);
  if (array.ndim() != 2 || array.shape(1) != 3)
    throw Bad_argument(name + " must have the shape (n, 3), but got " + shape_of(array));
  return array;
}

py::array_t<double, py::array::c_style> rows_or_none_of(const py::object& rows, const std::string& name) {
  const auto array = numbers_of(rows, name);
  if (array.ndim() == 1 && array.size() == 0) return py::array_t<double>(py::array::ShapeContainer{0, 3});
  return rows_of(rows, name);
}

Eigen::Matrix4d matrix_of(const py::object& matrix, const std::string& name) {
  const auto numbers = numbers_of(matrix, name);
  if (numbers.ndim() != 2 || numbers.shape(0) != 4 || numbers.shape(1) != 4)
    throw Bad_argument(name + " must have the shape (4, 4)");
  const Eigen::Matrix4d m = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data());
  if (!m.allFinite()) throw Bad_argument(name + " has a number that is not finite");
  if (m.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) throw Bad_argument("the last row of " + name + " must be 0, 0, 0, 1");
  return m;
}

std::array<double, 3> vector_of(const py::object& vector, const std::string& name) {
  const auto array = numbers_of(vector, name);
  if (array.ndim() != 1 || array.size() != 3)
    throw Bad_argument(name + " must be three numbers, but has the shape " + shape_of(array));
  return {array.at(0), array.at(1), array.at(2)};
}

Given_mesh given_mesh(const py::object& mesh, const py::object& faces, const std::string& name) {
  if (!faces.is_none()) return {mesh, faces};
  if (auto vertices = attribute_of(mesh, "vertices"))
    if (auto its_faces = attribute_of(mesh, "faces")) return {std::move(vertices), std::move(its_faces)};
  if (py::isinstance<py::tuple>(mesh) && py::len(mesh) == 2) {
    const auto pair = py::reinterpret_borrow<py::tuple>(mesh);
    return {pair[0], pair[1]};
  }
  throw Bad_argument(name + " must be a tuple of vertices and faces, or an object that has both");
}

py::array_t<double> positions_array(Coordinates coordinates) {
  py::array_t<double> array({static_cast<py::ssize_t>(coordinates.size() / 3), py::ssize_t{3}});
  std::copy(coordinates.begin(), coordinates.end(), array.mutable_data());
  return array;
}

py::array_t<std::int64_t> faces_array(std::span<const Corners> faces) {
  py::array_t<std::int64_t> array({static_cast<py::ssize_t>(faces.size()), py::ssize_t{3}});
  auto* to = array.mutable_data();
  for (const auto& corners : faces)
    for (const auto corner : corners) *to++ = corner;
  return array;
}

}  // namespace lodestone::python
