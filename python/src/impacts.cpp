// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <vector>

#include "detector_methods.h"
#include "one_call.h"

namespace lodestone::python {

namespace {

/// Of two objects, or of one with itself.
py::dict object_impact_fields(const Object_impact& impact) {
  py::dict fields = impact_fields(impact.impact);
  fields["objects"] = py::make_tuple(impact.objects.a, impact.objects.b);
  return fields;
}

std::vector<Positions> ends_of(const py::sequence& ends) {
  std::vector<Positions> all(ends.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    if (const py::object end = ends[i]; !end.is_none()) {
      const auto rows = rows_or_none_of(end, "ends[" + std::to_string(i) + "]");
      all[i] = Eigen::Map<const Positions>(rows.data(), static_cast<Eigen::Index>(rows.shape(0)), 3);
    }
  return all;
}

py::object first_impact_of_all(Python_detector& self, const py::sequence& ends) {
  const std::vector<Positions> all = ends_of(ends);
  const auto first = self.ask([&](auto& detector) { return detector.first_impact(all); });
  return first ? py::object(object_impact_fields(*first)) : py::none();
}

py::list first_impacts(Python_detector& self, const py::sequence& ends) {
  const std::vector<Positions> all = ends_of(ends);
  py::list impacts;
  for (const auto& impact : self.ask([&](auto& detector) { return detector.first_impacts(all); }))
    impacts.append(object_impact_fields(impact));
  return impacts;
}

}  // namespace

void add_impacts(Detector_class& type) {
  type
      .def("first_impact",
           [](Python_detector& self, Object_id a, const py::object& end_a, Object_id b, const py::object& end_b) {
             const Positions at_end_a = positions_of(end_a, "end_a"), at_end_b = positions_of(end_b, "end_b");
             return impact_fields(
                 self.ask([&](auto& detector) { return detector.first_impact(a, at_end_a, b, at_end_b); }));
           },
           py::arg("a"), py::arg("end_a"), py::arg("b"), py::arg("end_b"),
           "When two objects first meet if every vertex moves on a straight line, from where it is now at t = 0 to the row\n"
           "of end_a or end_b, arrays (V, 3), at t = 1, all as in `vertices(object)`: a dict with time, faces and\n"
           "point; None if they do not. Exact.")
      .def("first_self_impact",
           [](Python_detector& self, Object_id object, const py::object& end) {
             const Positions at_end = positions_of(end, "end");
             return impact_fields(self.ask([&](auto& detector) { return detector.first_self_impact(object, at_end); }));
           },
           py::arg("object"), py::arg("end"),
           "When two faces of one object that share no vertex first meet on the way to end, an array (V, 3): a dict with\n"
           "time, faces and point; None if they do not. Exact.")
      .def("first_impact_of_all", first_impact_of_all, py::arg("ends"),
           "The earliest impact of any two objects: a dict with objects, time, faces and point; None if there is none.\n"
           "With self_collision also of any object with itself.\n"
           "ends: a list with where the vertices of each object will be, (V, 3), or None or no rows for one that stays.")
      .def("first_impacts", first_impacts, py::arg("ends"),
           "The first impact of each pair of objects that meet: a list of dicts as of first_impact_of_all, in the order of\n"
           "the pairs. With self_collision each object is also paired with itself.");
}

}  // namespace lodestone::python
