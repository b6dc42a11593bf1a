// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>

#include <limits>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "detector.h"
#include "lodestone/bounds/box_promise.h"
#include "lodestone/bounds/displacement_bound.h"
#include "lodestone/bounds/lipschitz_bound.h"
#include "lodestone/bounds/stretch_bound.h"
#include "lodestone/mesh/errors.h"
#include "one_call.h"

/// The class Detector of the module.
namespace lodestone::python {

namespace {

using Pointer = std::shared_ptr<Python_detector>;

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

/// Rays from arrays of origins and directions; a single direction is that of all rays.
std::vector<Ray> rays_of(const py::object& origins, const py::object& directions, double length) {
  const auto from = rows_of(origins, "origins");
  auto along = numbers_of(directions, "directions");
  const bool one_direction = along.ndim() == 1 && along.size() == 3;
  if (!one_direction && (along.ndim() != 2 || along.shape(1) != 3 || along.shape(0) != from.shape(0)))
    throw Bad_argument("directions must have the shape (3,), or that of origins");
  std::vector<Ray> rays;
  for (py::ssize_t i = 0; i < from.shape(0); ++i) {
    const double *o = from.data(i, 0), *d = one_direction ? along.data() : along.data(i, 0);
    rays.push_back({.origin = {o[0], o[1], o[2]}, .direction = {d[0], d[1], d[2]}, .length = length});
  }
  return rays;
}

Ray ray_of(const py::object& origin, const py::object& direction, double length) {
  const auto o = vector_of(origin, "origin"), d = vector_of(direction, "direction");
  return {.origin = {o[0], o[1], o[2]}, .direction = {d[0], d[1], d[2]}, .length = length};
}

py::dict hit_of(const Ray_hit& hit) {
  py::dict fields;
  fields["face"] = hit.face;
  fields["t"] = hit.t;
  fields["point"] = array_of<double>(hit.point);
  return fields;
}

py::list all_hits(Python_detector& self, Object_id object, const py::object& origin, const py::object& direction,
                  double length) {
  const Ray ray = ray_of(origin, direction, length);
  py::list list;
  for (const auto& hit : self.ask([&](auto& detector) { return detector.all_hits(object, ray); }))
    list.append(hit_of(hit));
  return list;
}

/// One object, or several; none: all.
using Objects_on_ray = std::variant<Object_id, std::optional<std::vector<Object_id>>>;

std::vector<std::optional<Object_hit>> hits_among(Python_detector& self, const Objects_on_ray& objects,
                                                  std::span<const Ray> rays) {
  if (const auto* object = std::get_if<Object_id>(&objects)) {
    std::vector<std::optional<Object_hit>> hits;
    for (const auto& hit : self.ask([&](auto& detector) { return detector.first_hits(*object, rays); }))
      hits.push_back(hit ? std::optional(Object_hit{*object, *hit}) : std::nullopt);
    return hits;
  }
  const auto& some = std::get<1>(objects);
  return self.ask([&](auto& detector) { return some ? detector.first_hits(*some, rays) : detector.first_hits(rays); });
}

py::object first_hit(Python_detector& self, const Objects_on_ray& objects, const py::object& origin,
                     const py::object& direction, double length) {
  const Ray ray = ray_of(origin, direction, length);
  const auto hit = hits_among(self, objects, {&ray, 1}).front();
  if (!hit) return py::none();
  py::dict fields = hit_of(hit->hit);
  fields["object"] = hit->object;
  return fields;
}

py::dict first_hits(Python_detector& self, const Objects_on_ray& objects, const py::object& origins,
                    const py::object& directions, double length) {
  const auto hits = hits_among(self, objects, rays_of(origins, directions, length));
  const auto count = static_cast<py::ssize_t>(hits.size());
  py::array_t<std::int64_t> ids(count), faces(count);
  py::array_t<double> t(count), points({count, py::ssize_t{3}});
  for (py::ssize_t i = 0; i < count; ++i) {
    const auto& hit = hits[static_cast<std::size_t>(i)];
    ids.mutable_at(i) = hit ? std::int64_t{hit->object} : -1;
    faces.mutable_at(i) = hit ? std::int64_t{hit->hit.face} : -1;
    t.mutable_at(i) = hit ? hit->hit.t : std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis)
      points.mutable_at(i, axis) = hit ? hit->hit.point[axis] : std::numeric_limits<double>::quiet_NaN();
  }
  py::dict fields;
  fields["objects"] = ids;
  fields["faces"] = faces;
  fields["t"] = t;
  fields["points"] = points;
  return fields;
}

/// Of two objects, or of one with itself.
py::dict object_impact_fields(const Object_impact& impact) {
  py::dict fields = impact_fields(impact.impact);
  fields["objects"] = py::make_tuple(impact.objects.a, impact.objects.b);
  return fields;
}

std::vector<Positions> ends_of(const py::sequence& ends) {
  std::vector<Positions> all(ends.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    if (const py::object end = ends[i]; !end.is_none()) all[i] = positions_of(end, "ends[" + std::to_string(i) + "]");
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

Point point_of(const py::object& point) {
  const auto p = vector_of(point, "point");
  return {p[0], p[1], p[2]};
}

std::vector<Point> points_of(const py::object& points) {
  const auto rows = rows_of(points, "points");
  std::vector<Point> list;
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) list.emplace_back(rows.at(i, 0), rows.at(i, 1), rows.at(i, 2));
  return list;
}

py::dict closest_point(Python_detector& self, Object_id object, const py::object& point) {
  const Point asked = point_of(point);
  const auto found = self.ask([&](auto& detector) { return detector.closest_point(object, asked); });
  py::dict fields;
  fields["face"] = found.face;
  fields["point"] = point_array(found.point);
  fields["distance"] = found.distance;
  return fields;
}

py::dict closest_points(Python_detector& self, Object_id object, const py::object& points) {
  const auto asked = points_of(points);
  const auto found = self.ask([&](auto& detector) { return detector.closest_points(object, asked); });
  const auto count = static_cast<py::ssize_t>(found.size());
  py::array_t<std::int64_t> faces(count);
  py::array_t<double> distances(count), nearest({count, py::ssize_t{3}});
  for (py::ssize_t i = 0; i < count; ++i) {
    const auto& one = found[static_cast<std::size_t>(i)];
    faces.mutable_at(i) = one.face;
    distances.mutable_at(i) = one.distance;
    for (int axis = 0; axis < 3; ++axis) nearest.mutable_at(i, axis) = one.point[axis];
  }
  py::dict fields;
  fields["faces"] = faces;
  fields["points"] = nearest;
  fields["distances"] = distances;
  return fields;
}

const char* name_of_side(Point_side side) {
  if (side == Point_side::on_surface) return "on_surface";
  return side == Point_side::inside ? "inside" : "outside";
}

py::array sides_array(Python_detector& self, Object_id object, const py::object& points) {
  const auto asked = points_of(points);
  const auto found = self.ask([&](auto& detector) { return detector.point_sides(object, asked); });
  py::array_t<std::int8_t> sides(static_cast<py::ssize_t>(found.size()));
  for (std::size_t i = 0; i < found.size(); ++i)
    sides.mutable_at(static_cast<py::ssize_t>(i)) =
        found[i] == Point_side::inside ? 1 : (found[i] == Point_side::on_surface ? 0 : -1);
  return sides;
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
  return array_of<std::int64_t>(
      self.change([&](auto& detector) { return detector.object(object).particles().at; }));
}

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
  const std::span per_region(distances.data(), static_cast<std::size_t>(distances.size()));
  if (frame.is_none()) {
    if (distances.ndim() == 0) return promise.move(*distances.data());
    return promise.move(per_region);
  }
  const auto numbers = numbers_of(frame, "frame");
  if (numbers.ndim() != 2 || numbers.shape(0) != 4 || numbers.shape(1) != 4)
    throw Bad_argument("frame must have the shape (4, 4)");
  const Eigen::Isometry3d rigid(Eigen::Matrix4d(Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data())));
  if (distances.ndim() == 0) return promise.move(*distances.data(), rigid);
  promise.move(per_region, rigid);
}

void add_promises(py::module_& module) {
  py::class_<Displacement_promise>(module, "DisplacementPromise",
                                   "A promise, in mode `certified`: how far a vertex can have moved since `move` was last "
                                   "called. Call `move` before\nyou ask the detector about new positions.")
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

}  // namespace

void add_detector(py::module_& module) {
  add_promises(module);
  add_held(module);
  const auto infinity = std::numeric_limits<double>::infinity();
  py::class_<Python_detector, Pointer>(
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
      "  particles         particles, or regions in mode 'exact'; 0: as the mode sees fit; in mode 'exact' none, or\n"
      "                    12 with a strategy or a setting of it\n"
      "  strategy          how surfaces are divided: 'lbg'. It can be a function, see `partition`. Its settings are seed,\n"
      "                    normal_weight, lbg_split, lbg_epsilon, lbg_tolerance and lbg_sample\n"
      "  keep_islands      whether a region may consist of several islands: False\n"
      "and, of the modes with particles: least_particles, meetings, opening_budget, opening_reach, collision_distance,\n"
      "distance_measure, candidates, list_candidates, close_seams and growth; of the modes 'exact' and\n"
      "'certified': loosest and throw_if_broken.")
      .def(py::init([](const py::kwargs& keywords) {
        const auto settings = detector_settings(keywords);
        if (settings.options.exact.self_tolerance > 0 && !settings.options.exact.self_collision)
          throw Bad_argument("the option self_tolerance needs self_collision=True");
        return std::make_shared<Python_detector>(settings);
      }))
      .def("add", &Python_detector::add, py::arg("mesh"), py::arg("faces") = py::none(), py::kw_only(),
           py::arg("name") = "", py::arg("particles") = 0, py::arg("groups") = 1, py::arg("meets") = 0xffffffffu,
           py::arg("file_vertex") = py::none(),
           "Adds an object, and returns its id: 0, 1, ...\n\n"
           "mesh: vertices, an array (V, 3), with `faces` (F, 3); or an object that has both; or an Animation, or a Skin "
           "with `faces`.\nname: for messages. particles: of this object, 0: as the detector's options say.\n"
           "groups, meets: bits. Two objects are checked if each belongs to a group that the other meets.\n"
           "file_vertex: (V,) int; vertices with the same number are one.\n"
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
           "Gives an object other faces. changed: the indices of those that are others than before, where they are known;\n"
           "in mode 'exact' that saves most of the time.")
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
           "ends: a list with where the vertices of each object will be, (V, 3), or None or no rows for one that stays.")
      .def("first_impacts", first_impacts, py::arg("ends"),
           "The first impact of each pair of objects that meet: a list of dicts as of first_impact_of_all, in the order of\n"
           "the pairs. With self_collision each object is also paired with itself.")
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
           py::arg("outer"), py::arg("inner"), "Whether one object lies inside another, whose surface is closed. Exact.")
      .def("parting", parting, py::arg("a"), py::arg("b"),
           "A short translation of a that parts it from b: (3,). None if they are apart.")
      .def("visit", visit, py::arg("a"), py::arg("b"), py::arg("visitor"),
           "Calls visitor(face_a, face_b) with contacts, one by one, until it returns something true.\nReturns whether all "
           "have been shown.")
      .def("first_hit", first_hit, py::arg("object"), py::arg("origin"), py::arg("direction"),
           py::arg("length") = infinity,
           "The first face that a ray meets: a dict with object, face, t (in multiples of direction) and point; None if there\n"
           "is none. `object` is one object, a list of them, or None for all; groups and ignored pairs do not count. Exact:\n"
           "of several faces at the same t, that of the lowest object, and of this the lowest.")
      .def("all_hits", all_hits, py::arg("object"), py::arg("origin"), py::arg("direction"), py::arg("length") = infinity,
           "All faces of an object that a ray meets, in order along it: a list of dicts with face, t and point.")
      .def("first_hits", first_hits, py::arg("object"), py::arg("origins"), py::arg("directions"),
           py::arg("length") = infinity,
           "`first_hit` of many rays: a dict of arrays objects (n,), faces (n,), t (n,) and points (n, 3); a ray that meets\n"
           "nothing has object and face -1.")
      .def("closest_point", closest_point, py::arg("object"), py::arg("point"),
           "The face that is nearest to a point: a dict with face, point and distance.")
      .def("closest_points", closest_points, py::arg("object"), py::arg("points"),
           "`closest_point` of many points: a dict of arrays faces (n,), points (n, 3) and distances (n,).")
      .def("point_side",
           [](Python_detector& self, Object_id object, const py::object& point) {
             const Point asked = point_of(point);
             return name_of_side(self.ask([&](auto& detector) { return detector.point_side(object, asked); }));
           },
           py::arg("object"), py::arg("point"),
           "On which side of an object's surface, which is closed, a point is: 'inside', 'outside' or 'on_surface'. Exact.")
      .def("point_sides", sides_array, py::arg("object"), py::arg("points"),
           "`point_side` of many points: (n,) int8: 1 inside, -1 outside, 0 on the surface.")
      .def("promise", promise_any, py::arg("object"), py::arg("promise"),
           "Promises something about how an object moves, in mode 'certified'. If a vertex that is read breaks the promise, the\n"
           "object is read as a whole. If none of those that break it is read, a collision can be missed.")
      .def("ignore",
           [](Python_detector& self, Object_id a, Object_id b, bool ignored) {
             self.change([&](auto& detector) { detector.ignore(a, b, ignored); });
           },
           py::arg("a"), py::arg("b"), py::arg("ignored") = true,
           "Leaves out a pair of objects, or takes it in again; a = b: collisions of a with itself.")
      .def("remove", &Python_detector::remove, py::arg("object"),
           "Removes an object. The others keep their ids, and none gets this one again.")
      .def("save", save, py::arg("object"), "What has been built of an object, as bytes for `load`.")
      .def("load", load, py::arg("object"), py::arg("saved"),
           "Takes what was saved of an object with the same faces, in place of building it.")
      .def("regions", regions, py::arg("object"), "The region of each vertex: (V,) int64. After the first `detect`.")
      .def("particles", particles, py::arg("object"),
           "The vertex of each particle: (particles,) int64. Modes 'particles' and 'senin', after the first `detect`.")
      .def("vertices", &Python_detector::positions, py::arg("object"), "Where the vertices of an object are, its placement included: (V, 3), a copy.")
      .def("name", &Python_detector::name, py::arg("object"), "The name of an object.")
      .def("__len__", [](Python_detector& self) { return self.look([](auto& detector) { return detector.size(); }); },
           "Number of objects added, removed ones included.")
      .def("__repr__", &Python_detector::text)
      .def("__contains__", [](Python_detector& self, Object_id object) {
        return self.look([&](auto& detector) { return detector.has(object); });
      }, py::arg("object"), "Whether there is an object with this id.");
}

}  // namespace lodestone::python
