// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <concepts>
#include <type_traits>
#include <utility>

namespace lodestone::python {

/// Takes integers of Python and numpy. pybind11's own caster would cut the fraction of what else can be converted, such
/// as a `numpy.float32` or a `decimal.Decimal`.
template <std::integral Number>
class Integer_caster {
 public:
  PYBIND11_TYPE_CASTER(Number, pybind11::detail::const_name("int"));

  bool load(pybind11::handle source, bool /*convert*/) {
    if (!source || PyIndex_Check(source.ptr()) == 0) return false;
    const auto integer = pybind11::reinterpret_steal<pybind11::object>(PyNumber_Index(source.ptr()));
    const auto number = integer ? number_of(integer) : 0;
    const bool fits = integer && PyErr_Occurred() == nullptr && std::in_range<Number>(number);
    PyErr_Clear();
    value = static_cast<Number>(number);
    return fits;
  }
  static pybind11::handle cast(Number number, pybind11::return_value_policy /*policy*/, pybind11::handle /*parent*/) {
    if constexpr (std::is_signed_v<Number>)
      return PyLong_FromLongLong(number);
    else
      return PyLong_FromUnsignedLongLong(number);
  }

 private:
  static auto number_of(pybind11::handle integer) {
    if constexpr (std::is_signed_v<Number>)
      return PyLong_AsLongLong(integer.ptr());
    else
      return PyLong_AsUnsignedLongLong(integer.ptr());
  }
};

}  // namespace lodestone::python

namespace pybind11::detail {

template <>
class type_caster<unsigned int> : public lodestone::python::Integer_caster<unsigned int> {};
template <>
class type_caster<long> : public lodestone::python::Integer_caster<long> {};
template <>
class type_caster<unsigned long> : public lodestone::python::Integer_caster<unsigned long> {};

}  // namespace pybind11::detail
