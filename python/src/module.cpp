// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/pybind11.h>

#include <exception>
#include <string>

#include "frame.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/version.h"
#include "motion.h"
#include "one_call.h"
#include "partition.h"
#include "text.h"

namespace lodestone::python {

void add_detector(py::module_& module);
void add_files(py::module_& module);
void add_pages(py::module_& module);

namespace {

/// Makes an exception that stands for a type of the library's. Its text may hold names of files, which are any bytes.
template <class Type>
py::object add_error(py::module_& module, const char* name, const py::object& bases) {
  static py::handle raised;
  const py::exception<Type> type(module, name, bases);
  raised = type;
  raised.inc_ref();  // for as long as the process lives
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Type& error) {
      PyErr_SetObject(raised.ptr(), text_of(error.what()).ptr());
    }
  });
  return type;
}

/// Each typed error is a class of its own, below `Error`.
void add_errors(py::module_& module) {
  auto error = add_error<Error>(module, "Error", py::reinterpret_borrow<py::object>(PyExc_Exception));
  error.attr("__doc__") = "Base of every error of Lodestone. Its text says what, where, and what was expected.";
  const auto add = [&]<class Type>(const char* name, const char* text, const py::object& also) {
    const py::tuple bases = also.is_none() ? py::make_tuple(error) : py::make_tuple(error, also);
    auto type = add_error<Type>(module, name, bases);
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

/// The classes of the module that stand for types of C++.
py::list bound_classes(const py::module_& module) {
  const py::handle base(reinterpret_cast<PyObject*>(py::detail::get_internals().instance_base));
  py::list classes;
  for (const auto& [name, value] : py::cast<py::dict>(module.attr("__dict__")))
    if (py::isinstance<py::type>(value) && PyObject_IsSubclass(value.ptr(), base.ptr()) == 1) classes.append(value);
  return classes;
}

/// Refuses objects whose `__init__` has not been called, or not yet. pybind11 would give them memory that nothing has
/// been written to.
void refuse_uninitialised(const py::module_& module) {
  for (const py::handle type : bound_classes(module))
    py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(type.ptr()))->operator_new = [](std::size_t) -> void* {
      throw py::type_error("the object has not been initialised: call __init__ of its class first");
    };
}

/// Lets every class be reduced for `pickle`, or refused, in one way. Python's own way for protocols 0 and 1 makes an
/// instance of the base of all classes of pybind11, which ends the process.
void add_reduce(const py::module_& module) {
  const py::object anew = py::module_::import("copyreg").attr("__newobj__");
  const auto reduce = [anew](const py::object& self) {
    const py::object type = py::type::of(self);
    if (!py::hasattr(self, "__setstate__"))
      throw py::type_error("cannot pickle '" + py::cast<std::string>(type.attr("__name__")) + "' object");
    return py::make_tuple(anew, py::make_tuple(type), self.attr("__getstate__")());
  };
  for (const py::handle type : bound_classes(module))
    py::setattr(type, "__reduce__", py::cpp_function(reduce, py::is_method(type), py::name("__reduce__")));
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
  add_partitions(module);
  add_files(module);
  add_pages(module);
  refuse_uninitialised(module);
  add_reduce(module);
}
