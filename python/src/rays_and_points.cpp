// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>

#include <limits>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "detector_methods.h"
#include "lodestone/mesh/errors.h"

namespace lodestone::python {

namespace {

/// Rays from arrays of origins and directions; a single direction is that of all rays.
std::vector<Ray> rays_of(const py::object& origins, const py::object& directions, double length) {
  const auto from = rows_or_none_of(origins, "origins");
  auto along = numbers_of(directions, "directions");
  const bool one_direction = along.ndim() == 1 && along.size() == 3;
  if (from.shape(0) == 0 && along.size() == 0) return {};
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
  const auto hit = self.ask([&](auto& detector) -> std::optional<Object_hit> {
    if (const auto* object = std::get_if<Object_id>(&objects)) {
      const auto of_object = detector.first_hit(*object, ray);
      return of_object ? std::optional(Object_hit{*object, *of_object}) : std::nullopt;
    }
    const auto& some = std::get<1>(objects);
    return some ? detector.first_hit(*some, ray) : detector.first_hit(ray);
  });
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

Point point_of(const py::object& point) {
  const auto p = vector_of(point, "point");
  return {p[0], p[1], p[2]};
}

std::vector<Point> points_of(const py::object& points) {
  const auto rows = rows_or_none_of(points, "points");
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

}  // namespace

void add_rays_and_points(Detector_class& type) {
  const auto infinity = std::numeric_limits<double>::infinity();
  type
      .def("first_hit", first_hit, py::arg("object"), py::arg("origin"), py::arg("direction"),
           py::arg("length") = infinity,
           "The first face that a ray meets: a dict with object, face, t (in multiples of direction) and point; None if there\n"
           "is none. `object` is one object, a list of them, or None for all; groups and ignored pairs do not count. The ray\n"
           "ends at `length`, in multiples of direction. Exact: of several faces at the same t, that of the lowest object,\n"
           "and of this the lowest.")
      .def("all_hits", all_hits, py::arg("object"), py::arg("origin"), py::arg("direction"), py::arg("length") = infinity,
           "All faces of an object that a ray meets, in order along it: a list of dicts with face, t and point. The ray ends\n"
           "at `length`, in multiples of direction.")
      .def("first_hits", first_hits, py::arg("object"), py::arg("origins"), py::arg("directions"),
           py::arg("length") = infinity,
           "`first_hit` of many rays: a dict of arrays objects (n,), faces (n,), t (n,) and points (n, 3); a ray that meets\n"
           "nothing has object and face -1. All end at `length`, in multiples of their directions.")
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
           "On which side of an object's surface, which is closed, a point is: 'inside', 'outside' or 'on_surface'. Exact.\n"
           "If the surface is not closed, 'inside' and 'outside' mean nothing.")
      .def("point_sides", sides_array, py::arg("object"), py::arg("points"),
           "`point_side` of many points: (n,) int8: 1 inside, -1 outside, 0 on the surface.");
}

}  // namespace lodestone::python
