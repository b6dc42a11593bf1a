// SPDX-License-Identifier: GPL-3.0-or-later
#include "partition.h"

#include "asked_mesh.h"
#include "pickled.h"

namespace lodestone::python {

namespace {

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
  measures["parts_per_region"] = m.parts_per_region;
  measures["border_length"] = m.border_length;
  measures["normal_deviation"] = m.normal_deviation;
  measures["geodesic_radius"] = m.geodesic_radius;
  measures["box_volume"] = m.box_volume;
  measures["ball_volume"] = m.ball_volume;
  return measures;
}

}  // namespace

void add_partitions(py::module_& module) {
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
                             "  parts_per_region   before islands were repaired\n"
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
