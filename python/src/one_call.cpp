// SPDX-License-Identifier: GPL-3.0-or-later
#include "one_call.h"

#include "asked_mesh.h"
#include "lodestone/find_collisions.h"

namespace lodestone::python {

namespace {

Python_frame as_frame(Frame frame, const Detector_options& options) {
  return {std::make_shared<Frame>(std::move(frame)), options.contact_points, options.contact_normals};
}

py::object find_collisions(const py::object& mesh_a, const py::object& mesh_b, const py::kwargs& keywords) {
  const auto settings = detector_settings(keywords);
  const auto& options = settings.options;
  const Asked_mesh a(mesh_a, py::none(), "a"), b(mesh_b, py::none(), "b");
  Frame frame;
  {
    const Without_gil without_gil;
    if (auto at_once = frame_at_once(a.mesh, b.mesh, options)) {
      frame = std::move(*at_once);
    } else {
      Detector<Any_strategy> detector(options, settings.strategy.make(settings.strategy_settings));
      detector.add(a.mesh, {.name = "a"}), detector.add(b.mesh, {.name = "b"});
      frame = finds_all(options.mode) ? detector.detect(0, 1) : detector.detect();
    }
  }
  return only_pair(as_frame(std::move(frame), options));
}

py::object self_collisions(const py::object& mesh, const py::object& faces, const py::object& file_vertex,
                           const py::kwargs& keywords) {
  const auto settings = detector_settings(keywords);
  if (settings.options.exact.self_tolerance > 0)
    throw Bad_argument("self_tolerance compares with the object at rest, which one call does not know: use a Detector");
  const Asked_mesh asked(mesh, faces, "mesh");
  std::vector<std::uint32_t> doubled;
  if (!file_vertex.is_none()) doubled = indices_of(file_vertex, "file_vertex");
  Frame frame;
  {
    const Without_gil without_gil;
    frame = self_frame_at_once(asked.mesh, settings.options, doubled);
  }
  if (frame.pairs.empty()) frame.pairs.push_back({.a = 0, .b = 0});
  return only_pair(as_frame(std::move(frame), settings.options));
}

/// Asks a detector of two meshes.
template <class Question>
auto ask_about(const py::object& mesh_a, const py::object& mesh_b, std::size_t threads, const Question& question) {
  constexpr const char *first = "the first argument", *second = "the second argument";
  const Asked_mesh a(mesh_a, py::none(), first), b(mesh_b, py::none(), second);
  const Without_gil without_gil;
  Detector<Any_strategy> detector({.threads = threads});
  detector.add(a.mesh, {.name = first}), detector.add(b.mesh, {.name = second});
  return question(detector);
}

Closest_faces closest(const py::object& a, const py::object& b, std::size_t threads) {
  return ask_about(a, b, threads, [](auto& detector) { return detector.closest(0, 1); });
}

py::object first_impact(const py::object& a, const py::object& end_a, const py::object& b, const py::object& end_b) {
  const Positions at_end_a = positions_of(end_a, "end_a"), at_end_b = positions_of(end_b, "end_b");
  return impact_fields(
      ask_about(a, b, 1, [&](auto& detector) { return detector.first_impact(0, at_end_a, 1, at_end_b); }));
}

py::object first_self_impact(const py::object& mesh, const py::object& end, const py::object& file_vertex) {
  const Positions at_end = positions_of(end, "end");
  const Asked_mesh asked(mesh, py::none(), "mesh");
  Object_options options;
  if (!file_vertex.is_none()) options.file_vertex = indices_of(file_vertex, "file_vertex");
  std::optional<Impact> found;
  {
    const Without_gil without_gil;
    Detector<Any_strategy> detector;
    detector.add(asked.mesh, options);
    found = detector.first_self_impact(0, at_end);
  }
  return impact_fields(found);
}

bool within(const py::object& a, const py::object& b, double distance, std::size_t threads) {
  return ask_about(a, b, threads, [&](auto& detector) { return detector.within(0, 1, distance); });
}

bool contains(const py::object& outer, const py::object& inner, std::size_t threads) {
  return ask_about(outer, inner, threads, [](auto& detector) { return detector.contains(0, 1); });
}

}  // namespace

py::dict closest_fields(const Closest_faces& closest) {
  py::dict fields;
  fields["distance"] = closest.points.distance;
  fields["faces"] = py::make_tuple(closest.faces.a, closest.faces.b);
  fields["points"] = py::make_tuple(point_array(closest.points.a), point_array(closest.points.b));
  fields["direction"] = array_of<double>(closest.points.direction);
  return fields;
}

py::object impact_fields(const std::optional<Impact>& impact) {
  if (!impact) return py::none();
  py::dict fields;
  fields["time"] = impact->time;
  fields["faces"] = py::make_tuple(impact->faces.a, impact->faces.b);
  fields["point"] = point_array(impact->point);
  return fields;
}

Positions positions_of(const py::object& positions, const std::string& name) {
  const auto rows = rows_of(positions, name);
  return Eigen::Map<const Positions>(rows.data(), static_cast<Eigen::Index>(rows.shape(0)), 3);
}

void add_one_call(py::module_& module) {
  module.def("find_collisions", find_collisions, py::arg("a"), py::arg("b"),
             "Finds the collisions of two meshes with one call: a Pair, which is true if they collide.\n\n"
             "a, b: an object with `vertices` and `faces`, or a tuple (vertices, faces). Options as of Detector; only\n"
             "what is between the two counts, so `self_collision` changes nothing.");
  module.def("self_collisions", self_collisions, py::arg("mesh"), py::arg("faces") = py::none(),
             py::arg("file_vertex") = py::none(),
             "Finds the faces of one mesh that intersect each other: a Pair, with a = b, which is true if there are\n"
             "some. Faces that share a vertex count where they intersect beyond it. Options as of Detector, mode\n"
             "'exact'; those about two objects change nothing. `self_tolerance` needs a Detector.\n\n"
             "file_vertex: (V,) int; vertices with the same number are one, as at the seams of a mesh that stores them twice.");
  module.def(
      "closest",
      [](const py::object& a, const py::object& b, std::size_t threads) {
        return closest_fields(closest(a, b, threads));
      },
      py::arg("a"), py::arg("b"), py::kw_only(), py::arg("threads") = 1,
      "Where two meshes are closest: a dict with distance, faces, points and direction, from b to a.");
  module.def("first_impact", first_impact, py::arg("a"), py::arg("end_a"), py::arg("b"), py::arg("end_b"),
             "When two meshes first meet if every vertex moves on a straight line, from where it is at t = 0 to the row of\n"
             "end_a or end_b, arrays (V, 3), at t = 1: a dict with time, faces and point; None if they do not. Exact.");
  module.def("first_self_impact", first_self_impact, py::arg("mesh"), py::arg("end"), py::kw_only(),
             py::arg("file_vertex") = py::none(),
             "When two faces of one mesh that share no vertex first meet on the way to end, an array (V, 3): a dict with\n"
             "time, faces and point; None if they do not. Exact.\n\n"
             "file_vertex: (V,) int; vertices with the same number are one, as in `self_collisions`.");
  module.def("within", within, py::arg("a"), py::arg("b"), py::arg("distance"), py::kw_only(), py::arg("threads") = 1,
             "Whether two meshes are nearer to each other than a distance, or collide. Exact.");
  module.def("contains", contains, py::arg("outer"), py::arg("inner"), py::kw_only(), py::arg("threads") = 1,
             "Whether one mesh lies inside another, which is closed. Exact.");
}

}  // namespace lodestone::python
