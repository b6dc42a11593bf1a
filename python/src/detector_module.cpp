// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "detector_methods.h"
#include "lodestone/mesh/errors.h"
#include "one_call.h"
#include "text.h"

/// The class Detector of the module.
namespace lodestone::python {

namespace {

py::object detect(const py::object& self, std::optional<Object_id> a, std::optional<Object_id> b) {
  if (a.has_value() != b.has_value()) throw Bad_argument("give two objects, or none");
  auto& detector = self.cast<Python_detector&>();
  Python_frame frame = a ? detector.detect(*a, *b) : detector.detect();
  frame.detector = self;
  return py::cast(std::move(frame));
}

py::object self_collisions_of(const py::object& self, Object_id object) {
  auto& detector = self.cast<Python_detector&>();
  Python_frame frame = detector.detect(object, object);
  frame.detector = self;
  if (frame.frame->pairs.empty())
    throw Bad_argument("object " + std::to_string(object) +
                       " is left out of collisions with itself, by its groups or by `ignore`");
  return only_pair(std::move(frame));
}

py::object parting(Python_detector& self, Object_id a, Object_id b) {
  const auto found = self.ask([&](auto& detector) { return detector.parting(a, b); });
  if (!found) return py::none();
  return array_of<double>(found->translation);
}

bool visit(Python_detector& self, Object_id a, Object_id b, const py::function& visitor) {
  const Visit end = self.ask([&](auto& detector) {
    return detector.visit(a, b, [&](Face_pair faces) {
      const With_gil with_gil;
      const py::object stop = visitor(faces.a, faces.b);
      return py::bool_(stop) ? Visit::stop : Visit::go_on;
    });
  });
  return end == Visit::go_on;
}

py::bytes save(Python_detector& self, Object_id object) {
  const auto bytes = self.ask([&](auto& detector) { return detector.save(object); });
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void load(Python_detector& self, Object_id object, const py::bytes& saved) {
  const std::string_view bytes = saved;
  self.change([&](auto& detector) { detector.load(object, std::as_bytes(std::span(bytes))); });
}

/// Regions of the vertices.
py::object regions(Python_detector& self, Object_id object) {
  return array_of<std::int64_t>(self.change([&](auto& detector) { return detector.regions(object); }));
}

py::object particles(Python_detector& self, Object_id object) {
  if (finds_all(self.options().mode))
    throw Bad_argument("particles needs the mode particles or senin; modes exact and certified have no particles");
  const auto at = self.change([&](auto& detector) { return detector.object(object).particles().at; });
  if (at.empty())
    throw Bad_argument("object " + std::to_string(object) + " has no particles before the first query");
  return array_of<std::int64_t>(at);
}

/// What `with detector.hold_positions():` enters and leaves.
struct Held {
  py::object detector;
  std::size_t entered = 0;

  void begin() {
    detector.cast<Python_detector&>().hold_positions();
    ++entered;
  }
  void end() {
    if (entered == 0) throw Bad_argument("these positions are not held");
    --entered;
    detector.cast<Python_detector&>().release_positions();
  }
};

void add_held(py::module_& module) {
  py::class_<Held>(module, "HeldPositions", "See `Detector.hold_positions`.")
      .def("__enter__", &Held::begin)
      .def("__exit__", [](Held& self, const py::args&) { self.end(); });
}

/// What it holds, and where that is.
void add_objects(Detector_class& type) {
  type
      .def("add", &Python_detector::add, py::arg("mesh"), py::arg("faces") = py::none(), py::kw_only(),
           py::arg("name") = "", py::arg("particles") = 0, py::arg("groups") = 1, py::arg("meets") = 0xffffffffu,
           py::arg("file_vertex") = py::none(), py::arg("scattered_side") = py::none(),
           "Adds an object, and returns its id: 0, 1, ...\n\n"
           "mesh: vertices, an array (V, 3), with `faces` (F, 3); or an object that has both; or an Animation, or a Skin "
           "with `faces`.\nname: for messages. particles: of this object, 0: as the detector's options say.\n"
           "groups, meets: bits. Two objects are checked if each belongs to a group that the other meets.\n"
           "file_vertex: (V,) int; vertices with the same number are one.\n"
           "scattered_side: (3,), mode 'senin': particles start only where the surface lies farthest in this direction.\n"
           "Raises BadMesh: no face, or a face of a vertex that does not exist.")
      .def("set_vertices", &Python_detector::set_vertices, py::arg("object"), py::arg("vertices"),
           "Takes another array (V, 3) for the positions of an object.")
      .def("set_frame", &Python_detector::set_frame, py::arg("object"), py::arg("frame"),
           "Moves an object that has an animation to a frame; -1: the last, as in `animation[-1]`.\n"
           "Raises BadArgument: there is no such frame.")
      .def("update", &Python_detector::update, py::arg("object") = py::none(),
           "Tells the mode 'particles' that the vertices of an object, or of all, have been moved in their arrays, so that "
           "it\nrepartitions what has grown. `set_vertices` does so by itself. Other modes need it only while positions are "
           "held.")
      .def("hold_positions", [](py::object self) { return Held{std::move(self)}; },
           "Promises that no vertex moves in the block `with detector.hold_positions():`. No position is then read twice.\n"
           "What `place`, `set_vertices` and other methods of the detector change is noticed all the same. What is written\n"
           "into arrays, joints or weights is not: answers may then mix old and new positions. This holds for all threads\n"
           "that use the detector. Modes 'exact' and 'certified'.")
      .def("place", &Python_detector::place, py::arg("object"), py::arg("matrix"),
           "Places an object: from now on its vertices are at matrix * p, a rigid motion (4, 4).")
      .def("rebuild", &Python_detector::rebuild, py::arg("object"), py::arg("vertices"), py::arg("faces"), py::kw_only(),
           py::arg("changed") = py::none(), py::arg("file_vertex") = py::none(),
           "Gives an object other faces. changed: the indices of those whose corners are others than before, or in another\n"
           "order, where they are known; in mode 'exact' that saves most of the time. New faces at the end need not be listed.\n"
           "file_vertex: as in `add`, for the new vertices. Without it no vertices are joined, even if some were.\n"
           "Raises BadArgument: a face that has changed is not listed.")
      .def("ignore",
           [](Python_detector& self, Object_id a, Object_id b, bool ignored) {
             self.change([&](auto& detector) { detector.ignore(a, b, ignored); });
           },
           py::arg("a"), py::arg("b"), py::arg("ignored") = true,
           "Leaves out a pair of objects, or takes it in again; a = b: collisions of a with itself.")
      .def("remove", &Python_detector::remove, py::arg("object"),
           "Removes an object. The others keep their ids, and none gets this one again.")
      .def("vertices", &Python_detector::positions, py::arg("object"), "Where the vertices of an object are, its placement included: (V, 3), a copy.")
      .def("name", [](Python_detector& self, Object_id object) { return text_of(self.name(object)); },
           py::arg("object"), "The name of an object.")
      .def("__len__", [](Python_detector& self) { return self.look([](auto& detector) { return detector.size(); }); },
           "Number of objects added, removed ones included.")
      .def("__repr__", &Python_detector::text)
      .def("__contains__", [](Python_detector& self, const py::object& object) {
        py::detail::make_caster<Object_id> id;
        if (!id.load(object, true)) return false;  // no integer, or out of range
        return self.look([&](auto& detector) { return detector.has(py::detail::cast_op<Object_id>(id)); });
      }, py::arg("object"), "Whether there is an object with this id.");
}

/// What collides, and how far apart two objects are.
void add_answers(Detector_class& type) {
  type
      .def("detect", detect, py::arg("a") = py::none(), py::arg("b") = py::none(),
           "Finds the collisions between all objects where their vertices are now, or of objects a and b: a Frame.\n"
           "Pairs that groups or `ignore` leave out have no part in it, whichever are asked for.\n"
           "Raises BadMesh: a coordinate that is not finite.")
      .def("self_collisions", self_collisions_of, py::arg("object"),
           "Faces of one object that intersect each other: a Pair, a = b. Modes 'exact' "
           "and 'certified'.\nRaises BadArgument: groups or `ignore` leave it out.")
      .def("closest",
           [](Python_detector& self, Object_id a, Object_id b) {
             return closest_fields(self.ask([&](auto& detector) { return detector.closest(a, b); }));
           },
           py::arg("a"), py::arg("b"),
           "Where two objects are closest: a dict with distance, faces, points and direction, from b to a.")
      .def("within",
           [](Python_detector& self, Object_id a, Object_id b, double distance) {
             return self.ask([&](auto& detector) { return detector.within(a, b, distance); });
           },
           py::arg("a"), py::arg("b"), py::arg("distance"),
           "Whether two objects are nearer to each other than a distance, or collide. Exact.")
      .def("contains",
           [](Python_detector& self, Object_id outer, Object_id inner) {
             return self.ask([&](auto& detector) { return detector.contains(outer, inner); });
           },
           py::arg("outer"), py::arg("inner"), "Whether one object lies inside another. Exact. Nothing lies inside a surface that is not closed.")
      .def("parting", parting, py::arg("a"), py::arg("b"),
           "A short translation of a that parts it from b: (3,). None if they are apart, and neither lies inside the other.")
      .def("visit", visit, py::arg("a"), py::arg("b"), py::arg("visitor"),
           "Calls visitor(face_a, face_b) with contacts, one by one, until it returns something true.\nReturns whether all "
           "have been shown.");
}

/// What has been built.
void add_built(Detector_class& type) {
  type
      .def("save", save, py::arg("object"), "What has been built of an object, as bytes for `load`.")
      .def("load", load, py::arg("object"), py::arg("saved"),
           "Takes what was saved of an object with the same faces, in place of building it.")
      .def("regions", regions, py::arg("object"), "The region of each vertex: (V,) int64.\nRaises BadArgument: no `detect` since the object was added or rebuilt.")
      .def("particles", particles, py::arg("object"),
           "The vertex of each particle: (particles,) int64. Modes 'particles' and 'senin'.\nRaises BadArgument: no "
           "`detect` since the object was added or rebuilt.");
}

}  // namespace

void add_detector(py::module_& module) {
  add_promises(module);
  add_held(module);
  Detector_class type(
      module, "Detector",
      "Finds collisions between many deforming meshes, frame after frame.\n\n"
      "    detector = lodestone.Detector()\n"
      "    cloth = detector.add(vertices, faces)\n"
      "    ball = detector.add(ball_mesh)              # anything with .vertices and .faces\n"
      "    for vertices in simulation:\n"
      "        detector.set_vertices(cloth, vertices)\n"
      "        for pair in detector.detect().pairs:\n"
      "            print(pair.a, pair.b, pair.faces)\n\n"
      "Arrays of float64 or float32 are read where they are, by every query: what is written into them counts. All other\n"
      "arrays and lists are copied when they are given. Every call works without Python's global lock. Threads that use\n"
      "one detector wait for each other.\n\n"
      "Options are given by name. In the sources of Lodestone, docs/python.md explains each of them:\n"
      "  mode              'exact' (default), 'certified', 'particles' or 'senin'\n"
      "  contacts          'all' (default), 'first' or 'yes_no'\n"
      "  contact_points, contact_normals, patches, containment, parting     what else to find: False\n"
      "  self_collision    also faces of one object that intersect: False\n"
      "  tolerance, self_tolerance     report faces nearer than this, in units of the coordinates: 0\n"
      "  most_contacts     contacts listed per pair of objects: all\n"
      "  threads           at most so many; 0: all of the machine: 1. Results do not depend on it\n"
      "  particles         particles, or regions in the modes 'exact' and 'certified'; 0: as the mode sees fit; in\n"
      "                    these two none, or 12 with a strategy, a setting of it or keep_islands\n"
      "  strategy          how surfaces are divided: 'lbg'. It can be a function, see `partition`. Its settings are seed,\n"
      "                    normal_weight, lbg_split, lbg_epsilon, lbg_tolerance and lbg_sample\n"
      "  keep_islands      whether a region may consist of several islands: False\n"
      "and, of the modes with particles: least_particles, meetings, opening_budget, opening_reach, collision_distance,\n"
      "distance_measure, candidates, list_candidates, close_seams and growth; of the modes 'exact' and\n"
      "'certified': loosest; of the mode 'certified': throw_if_broken.");
  type.def(py::init([](const py::kwargs& keywords) {
    const auto settings = detector_settings(keywords);
    if (settings.options.exact.self_tolerance > 0 && !settings.options.exact.self_collision)
      throw Bad_argument("the option self_tolerance needs self_collision=True");
    return std::make_shared<Python_detector>(settings);
  }));
  add_objects(type);
  add_answers(type);
  add_impacts(type);
  add_rays_and_points(type);
  add_promise(type);
  add_built(type);
}

}  // namespace lodestone::python
