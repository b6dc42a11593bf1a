// SPDX-License-Identifier: GPL-3.0-or-later
#include "one_call.h"

#include "detector.h"
#include "lodestone/find_collisions.h"
#include "lodestone/mesh/errors.h"
#include "lodestone/partition/partition_measures.h"
#include "pickled.h"

namespace lodestone::python {

namespace {

/// A mesh that is asked about once.
struct Asked_mesh {
  Asked_mesh(const py::object& asked, const py::object& asked_faces, const std::string& name) try
      : given(given_mesh(asked, asked_faces, name)),
        faces(surface_of(given.faces)),
        vertices(given.vertices),
        mesh(vertices.coordinates(), faces) {
  } catch (const Bad_mesh& error) {
    throw Bad_mesh(name + ": " + error.what());
  }

  Given_mesh given;
  std::vector<Corners> faces;
  Live_vertices vertices;
  Indexed_mesh mesh;
};

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
  Detector<Any_strategy> detector({.exact = {.threads = threads}});
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

py::object first_self_impact(const py::object& mesh, const py::object& end) {
  const Positions at_end = positions_of(end, "end");
  const Asked_mesh asked(mesh, py::none(), "mesh");
  std::optional<Impact> found;
  {
    const Without_gil without_gil;
    Detector<Any_strategy> detector;
    detector.add(asked.mesh);
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

Python_partition divide(const py::object& mesh, const py::object& faces, const py::object& strategy,
                        std::size_t regions, const py::kwargs& keywords) {
  const auto settings = partition_settings(strategy, keywords);
  const Asked_mesh asked(mesh, faces, "mesh");
  const Without_gil without_gil;
  const Mesh_numbering<Indexed_mesh> numbering(asked.mesh);
  const Positions positions = read_positions(numbering, Indexed_points(asked.mesh));
  const Vertex_graph graph = vertex_graph(numbering.vertex_count(), numbering.corners());
  const Numbered_surface surface{graph, positions, numbering.corners()};
  Python_partition made{.strategy = settings.strategy.name, .partition = {}, .measures = {}};
  made.partition =
      partition_numbered(surface, regions, settings.strategy.make(settings.strategy_settings), settings.options);
  made.measures = measure_partition(surface, made.partition);
  return made;
}

py::dict measures_of(const Python_partition& self) {
  const auto& m = self.measures;
  py::dict measures;
  measures["distortion"] = m.distortion;
  measures["size_balance"] = m.size_balance;
  measures["pieces_per_region"] = m.pieces_per_region;
  measures["border_length"] = m.border_length;
  measures["normal_deviation"] = m.normal_deviation;
  measures["geodesic_radius"] = m.geodesic_radius;
  measures["box_volume"] = m.box_volume;
  measures["ball_volume"] = m.ball_volume;
  return measures;
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
             "'exact'; those about two objects change nothing.\n\n"
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
  module.def("first_self_impact", first_self_impact, py::arg("mesh"), py::arg("end"),
             "When two faces of one mesh that share no vertex first meet on the way to end, an array (V, 3): a dict with\n"
             "time, faces and point; None if they do not. Exact.");
  module.def("within", within, py::arg("a"), py::arg("b"), py::arg("distance"), py::kw_only(), py::arg("threads") = 1,
             "Whether two meshes are nearer to each other than a distance, or collide. Exact.");
  module.def("contains", contains, py::arg("outer"), py::arg("inner"), py::kw_only(), py::arg("threads") = 1,
             "Whether one mesh lies inside another, which is closed. Exact.");

  py::class_<Python_partition>(module, "Partition", "A surface divided into regions, each with one particle.")
      .def_property_readonly("labels",
                             [](const Python_partition& self) { return array_of<std::int64_t>(self.partition.labels); },
                             "The region of each vertex: (V,) int64.")
      .def_property_readonly("regions", [](const Python_partition& self) { return self.partition.regions; },
                             "Number of regions.")
      .def_property_readonly(
          "particles", [](const Python_partition& self) { return array_of<std::int64_t>(self.partition.particles); },
          "The vertex at which the particle of each region starts: (regions,) int64.")
      .def_readonly("strategy", &Python_partition::strategy, "Name of the strategy.")
      .def_property_readonly("measures", measures_of,
                             "How good it is: a dict. Smaller is better; no figure depends on the units of the mesh.\n"
                             "  distortion         mean squared distance to the region's mean in position + normal\n"
                             "  size_balance       vertices of the largest region over the mean\n"
                             "  pieces_per_region  before islands were repaired\n"
                             "  border_length      of all borders, over the square root of the area\n"
                             "  normal_deviation   degrees between the normal of a face and that of its region\n"
                             "  geodesic_radius    from a particle to the farthest vertex of its region, in radii of the "
                             "object\n"
                             "  box_volume, ball_volume  around the regions, over that around all")
      .def(py::pickle([](const Python_partition& self) { return pickled(self); }, &unpickled_partition))
      .def("__repr__", [](const Python_partition& self) {
        return "<lodestone.Partition " + self.strategy + ": " + std::to_string(self.partition.regions) + " regions of " +
               std::to_string(self.partition.labels.size()) + " vertices>";
      });
  module.def("partition", divide, py::arg("mesh"), py::arg("faces") = py::none(), py::arg("strategy") = "lbg",
             py::arg("regions") = 12,
             "Divides a surface into regions: a Partition. `strategies()` lists the strategies. One of your own is a function\n"
             "strategy(vertices, faces, regions) that returns the region of each vertex, any integer from 0 to V - 1: (V,) "
             "int.\n\n"
             "mesh: vertices, an array (V, 3), with `faces` (F, 3); or an object that has both. Further options: seed,\n"
             "keep_islands, threads, normal_weight, lbg_split, lbg_epsilon, lbg_tolerance, lbg_sample. Those that the\n"
             "strategy ignores are refused, except seed.");
  module.def(
      "strategies",
      [] {
        py::dict all;
        for (const auto& entry : strategies())
          all[py::str(std::string(entry.name))] = py::str(std::string(entry.summary));
        return all;
      },
      "The partition strategies: a dict from the name to what a region is.");
}

}  // namespace lodestone::python
