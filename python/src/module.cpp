// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>

#include "frame.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/version.h"
#include "motion.h"
#include "one_call.h"

namespace lodestone::python {

void add_detector(py::module_& module);
void add_files(py::module_& module);
void add_pages(py::module_& module);

namespace {

/// Each typed error is a class of its own, below `Error`.
void add_errors(py::module_& module) {
  auto error = py::register_exception<Error>(module, "Error");
  error.attr("__doc__") = "Base of every error of Lodestone. Its text says what, where, and what was expected.";
  const auto add = [&]<class Type>(const char* name, const char* text, const py::object& also) {
    const py::tuple bases = also.is_none() ? py::make_tuple(error) : py::make_tuple(error, also);
    auto type = py::register_exception<Type>(module, name, bases);
    type.attr("__doc__") = text;
  };
  const py::object value_error = py::reinterpret_borrow<py::object>(PyExc_ValueError);
  add.template operator()<Bad_mesh>("BadMesh", "A mesh that cannot be used.", value_error);
  add.template operator()<Bad_motion>("BadMotion", "A motion that is broken or does not fit its mesh.", value_error);
  add.template operator()<Bad_scene>("BadScene", "A scene file that is not a scene.", value_error);
  add.template operator()<Bad_saved_object>("BadSavedObject", "Bytes that `load` or `pickle` cannot use.", value_error);
  add.template operator()<Broken_bound>("BrokenBound", "A vertex that is not where a bound or a promise says.",
                                        py::none());
  add.template operator()<Bad_argument>("BadArgument", "An argument or option outside its range.", value_error);
  add.template operator()<Bad_output>("BadOutput", "A result that could not be written.", py::none());
}

}  // namespace

}  // namespace lodestone::python

PYBIND11_MODULE(_lodestone, module) {
  using namespace lodestone::python;
  module.doc() = "The compiled part of the package lodestone.";
  module.attr("__version__") = LODESTONE_VERSION_TEXT;
  add_errors(module);
  add_motions(module);
  add_frames(module);
  add_detector(module);
  add_one_call(module);
  add_files(module);
  add_pages(module);
}
