// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <concepts>
#include <limits>

namespace lodestone::python {

/// Takes integers of Python and numpy. pybind11's own caster would cut the fraction of what else can be converted, such
/// as a `numpy.float32` or a `decimal.Decimal`.
template <std::unsigned_integral Number>
class Integer_caster {
 public:
  PYBIND11_TYPE_CASTER(Number, pybind11::detail::const_name("int"));

  bool load(pybind11::handle source, bool /*convert*/) {
    if (!source || PyIndex_Check(source.ptr()) == 0) return false;
    const auto integer = pybind11::reinterpret_steal<pybind11::object>(PyNumber_Index(source.ptr()));
    const auto number = integer ? PyLong_AsUnsignedLongLong(integer.ptr()) : 0;
    const bool fits = integer && PyErr_Occurred() == nullptr && number <= std::numeric_limits<Number>::max();
    PyErr_Clear();
    value = static_cast<Number>(number);
    return fits;
  }
  static pybind11::handle cast(Number number, pybind11::return_value_policy /*policy*/, pybind11::handle /*parent*/) {
    return PyLong_FromUnsignedLongLong(number);
  }
};

}  // namespace lodestone::python

namespace pybind11::detail {

template <>
class type_caster<unsigned int> : public lodestone::python::Integer_caster<unsigned int> {};
template <>
class type_caster<unsigned long> : public lodestone::python::Integer_caster<unsigned long> {};

}  // namespace pybind11::detail
