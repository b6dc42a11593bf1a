// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <memory>
#include <span>
#include <utility>

#include "detector_methods.h"
#include "lodestone/bounds/box_promise.h"
#include "lodestone/bounds/displacement_bound.h"
#include "lodestone/bounds/lipschitz_bound.h"
#include "lodestone/bounds/stretch_bound.h"
#include "lodestone/mesh/errors.h"

namespace lodestone::python {

namespace {

template <class Promise>
void promise(Python_detector& self, Object_id object, const py::object& given) {
  self.promise(object, given.cast<const Promise&>(), given);
}

void promise_any(Python_detector& self, Object_id object, const py::object& given) {
  if (py::isinstance<Displacement_promise>(given)) return promise<Displacement_promise>(self, object, given);
  if (py::isinstance<Stretch_promise>(given)) return promise<Stretch_promise>(self, object, given);
  if (py::isinstance<Lipschitz_promise>(given)) return promise<Lipschitz_promise>(self, object, given);
  if (py::isinstance<Box_promise>(given)) return promise<Box_promise>(self, object, given);
  throw py::type_error("a promise is a DisplacementPromise, StretchPromise, LipschitzPromise or BoxPromise");
}

/// What a function of Python's answers. Called without the GIL.
Aabb box_of(const py::function& function, Region_index region, const Aabb& rest_box) {
  const With_gil with_gil;
  py::array_t<double> rest({2, 3});
  std::copy_n(rest_box.low, 3, rest.mutable_data(0, 0));
  std::copy_n(rest_box.high, 3, rest.mutable_data(1, 0));
  const py::object named = region == several_regions ? py::object(py::none()) : py::object(py::int_(region));
  const auto numbers = numbers_of(function(named, rest), "the box of a BoxPromise");
  if (numbers.ndim() != 2 || numbers.shape(0) != 2 || numbers.shape(1) != 3)
    throw Bad_argument("the box of a BoxPromise must have the shape (2, 3)");
  Aabb box{};
  std::copy_n(numbers.data(0, 0), 3, box.low);
  std::copy_n(numbers.data(1, 0), 3, box.high);
  return box;
}

std::unique_ptr<Box_promise> box_promise(py::function function) {
  return std::make_unique<Box_promise>([function = std::move(function)](Region_index region, const Aabb& rest_box) {
    return box_of(function, region, rest_box);
  });
}

void move(Displacement_promise& promise, const py::object& distance, const py::object& frame) {
  const auto distances = numbers_of(distance, "distance");
  if (distances.ndim() > 1) throw Bad_argument("distance must be a number, or one per region: of shape (regions,)");
  const std::span per_region(distances.data(), static_cast<std::size_t>(distances.size()));
  if (frame.is_none()) {
    if (distances.ndim() == 0) return promise.move(*distances.data());
    return promise.move(per_region);
  }
  const Eigen::Isometry3d rigid(matrix_of(frame, "frame"));
  if (distances.ndim() == 0) return promise.move(*distances.data(), rigid);
  promise.move(per_region, rigid);
}

}  // namespace

void add_promises(py::module_& module) {
  py::class_<Displacement_promise>(module, "DisplacementPromise",
                                   "A promise, in mode `certified`: how far a vertex can have moved since `move` was last "
                                   "called. Call `move` before\nyou ask the detector about new positions. Where `place` puts the object does not count.")
      .def(py::init<std::size_t>(), py::arg("regions") = 1)
      .def("move", move, py::arg("distance"), py::arg("frame") = py::none(),
           "No vertex has moved farther than `distance`, in units of the coordinates; or, of region i, than "
           "`distance[i]`.\nframe: (4, 4), a rigid motion that takes all vertices along, and does not count.");
  py::class_<Stretch_promise>(module, "StretchPromise",
                              "A promise, in mode `certified`: no edge is ever longer than `stretch` times its length at "
                              "rest.")
      .def(py::init<double, double>(), py::arg("stretch") = 1.0, py::arg("error") = 0.0)
      .def("set_stretch", &Stretch_promise::set_stretch, py::arg("stretch"), py::arg("error") = 0.0,
           "Promises another factor. error: how far a position may be from the exact one.");
  py::class_<Lipschitz_promise>(module, "LipschitzPromise",
                                "A promise, in mode `certified`: no two vertices are farther apart than `constant` times "
                                "their distance at rest.")
      .def(py::init<double, double>(), py::arg("constant") = 1.0, py::arg("error") = 0.0)
      .def("set_constant", &Lipschitz_promise::set_constant, py::arg("constant"), py::arg("error") = 0.0,
           "Promises another constant. error: how far a position may be from the exact one.");
  py::class_<Box_promise>(module, "BoxPromise",
                          "A promise, in mode `certified`, that a function of yours computes.\n\n"
                          "box(region, rest_box) returns an array of shape (2, 3): the lower and the upper corner of a box "
                          "that now contains every\nvertex of the region that was in `rest_box`, of the same shape, at rest. "
                          "An axis with an end that is not finite is open.\nregion is 0 where the detector makes no regions, "
                          "and None for vertices of several. The function must not call the detector.")
      .def(py::init(&box_promise), py::arg("box"));
}

void add_promise(Detector_class& type) {
  type
      .def("promise", promise_any, py::arg("object"), py::arg("promise"),
           "Promises something about how an object moves, in mode 'certified'. If a vertex that is read breaks the promise, the\n"
           "object is read as a whole. If none of those that break it is read, a collision can be missed. Promises about one object\n"
           "add up: make one, and change it from frame to frame.");
}

}  // namespace lodestone::python
