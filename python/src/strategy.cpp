// SPDX-License-Identifier: GPL-3.0-or-later
#include "strategy.h"

#include <pybind11/numpy.h>

#include <utility>

#include "arrays.h"
#include "gil.h"

namespace lodestone::python {

namespace {

/// Asks a function of Python's. The detector has released the GIL.
class Function_strategy {
 public:
  static constexpr std::string_view name = "function";

  explicit Function_strategy(Given_strategy given) : given_(std::move(given)) {}

  Labelling label(const Numbered_surface& surface, std::size_t regions) const {
    const With_gil with_gil;
    const auto& positions = surface.positions;
    const auto vertices = positions_array({positions.data(), static_cast<std::size_t>(positions.size())});
    const py::object labels = (*given_.function)(vertices, faces_array(surface.faces), regions);
    return {.labels = indices_of(labels, "labels of the strategy " + given_.name)};
  }

 private:
  Given_strategy given_;
};

}  // namespace

Any_strategy Given_strategy::make(const Strategy_settings& settings) const {
  if (!function) return make_strategy(name, settings);
  return Any_strategy(Function_strategy(*this));
}

Given_strategy given_strategy(const py::handle& strategy) {
  if (py::isinstance<py::str>(strategy)) return {.name = py::str(strategy), .function = nullptr};
  if (!py::isinstance<py::function>(strategy))
    throw py::type_error("the option strategy must be a name or a function, but is " +
                         py::repr(strategy).cast<std::string>());
  const auto release = [](const py::function* function) {
    const With_gil with_gil;
    delete function;
  };
  const py::object name = py::getattr(strategy, "__name__", py::type::handle_of(strategy).attr("__name__"));
  return {.name = py::str(name),
          .function = {new py::function(py::reinterpret_borrow<py::function>(strategy)), release}};
}

}  // namespace lodestone::python
