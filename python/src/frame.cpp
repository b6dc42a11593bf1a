// SPDX-License-Identifier: GPL-3.0-or-later
#include "frame.h"

#include <Eigen/Core>
#include <cmath>
#include <sstream>
#include <utility>

#include "arrays.h"
#include "lodestone/mesh/errors.h"
#include "pickled.h"

namespace lodestone::python {

namespace {

/// Makes an attribute when it is first asked for. The arrays of a frame are the same each time, and cannot be written to.
template <class Make>
py::object kept(const py::object& self, const char* name, const Make& make) {
  py::dict kept_ones = self.attr("__dict__");
  if (kept_ones.contains(name)) return kept_ones[name];
  py::object made = make(self.cast<const Python_frame&>());
  if (py::isinstance<py::array>(made)) made.attr("flags").attr("writeable") = false;
  kept_ones[name] = made;
  return made;
}

py::array_t<double> vectors_array(std::size_t count) {
  return py::array_t<double>({static_cast<py::ssize_t>(count), py::ssize_t{3}});
}

py::object faces_of_frame(const Python_frame& self) {
  const auto& pairs = self.frame->face_pairs;
  py::array_t<std::int64_t> array({static_cast<py::ssize_t>(pairs.size()), py::ssize_t{2}});
  auto* to = array.mutable_data();
  for (const auto& [a, b] : pairs) *to++ = a, *to++ = b;
  return array;
}

py::object intersects_of_frame(const Python_frame& self) {
  py::array_t<bool> array(static_cast<py::ssize_t>(self.frame->face_pairs.size()));
  auto* to = array.mutable_data();
  for (std::size_t contact = 0; contact < self.frame->face_pairs.size(); ++contact)
    *to++ = self.frame->intersects(contact);
  return array;
}

/// The middle of where two faces meet.
py::object points_of_frame(const Python_frame& self) {
  if (!self.with_points) return py::none();
  const auto& all = self.frame->contact_points;
  auto array = vectors_array(all.size());
  auto* to = array.mutable_data();
  for (const auto& corners : all) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& p : corners) sum += Eigen::Vector3d(p.x(), p.y(), p.z()) / static_cast<double>(corners.size());
    for (int i = 0; i < 3; ++i) *to++ = sum[i];
  }
  return array;
}

/// The two of its corners that are farthest apart.
std::pair<Point, Point> ends_of(const Intersection_points& corners) {
  // Squares would overflow or vanish at sizes beyond 10^+-154.
  const auto distance = [](const Point& p, const Point& q) {
    return std::hypot(p.x() - q.x(), p.y() - q.y(), p.z() - q.z());
  };
  std::pair<Point, Point> ends{corners.front(), corners.back()};
  double longest = distance(ends.first, ends.second);
  for (const auto& p : corners)
    for (const auto& q : corners)
      if (const double length = distance(p, q); length > longest) longest = length, ends = {p, q};
  return ends;
}

py::object segments_of_frame(const Python_frame& self) {
  if (!self.with_points) return py::none();
  const auto& all = self.frame->contact_points;
  py::array_t<double> array({static_cast<py::ssize_t>(all.size()), py::ssize_t{2}, py::ssize_t{3}});
  auto* to = array.mutable_data();
  for (const auto& corners : all) {
    const auto [from, till] = ends_of(corners);
    for (const auto& p : {from, till}) *to++ = p.x(), *to++ = p.y(), *to++ = p.z();
  }
  return array;
}

py::object outline_of(const Python_frame& self, std::size_t contact) {
  if (!self.with_points) return py::none();
  if (contact >= self.frame->contact_points.size()) throw py::index_error("there is no such contact");
  const auto& corners = self.frame->contact_points[contact];
  auto array = vectors_array(corners.size());
  auto* to = array.mutable_data();
  for (const auto& p : corners) *to++ = p.x(), *to++ = p.y(), *to++ = p.z();
  return array;
}

py::object normals_of_frame(const Python_frame& self) {
  if (!self.with_normals) return py::none();
  auto array = vectors_array(self.frame->contact_normals.size());
  auto* to = array.mutable_data();
  for (const auto& contact : self.frame->contact_normals)
    for (int i = 0; i < 3; ++i) *to++ = contact.normal[i];
  return array;
}

py::object depths_of_frame(const Python_frame& self) {
  if (!self.with_normals) return py::none();
  py::array_t<double> array(static_cast<py::ssize_t>(self.frame->contact_normals.size()));
  auto* to = array.mutable_data();
  for (const auto& contact : self.frame->contact_normals) *to++ = contact.depth;
  return array;
}

py::tuple pairs_of_frame(const py::object& self) {
  py::list pairs;
  for (const auto& result : self.cast<const Python_frame&>().frame->pairs)
    pairs.append(py::cast(Python_pair{self, result}));
  return py::tuple(pairs);
}


py::object patches_of_pair(const Python_pair& self) {
  py::list patches;
  for (const auto& patch : self.frame.cast<const Python_frame&>().frame->patches_of(self.result)) {
    py::dict fields;
    fields["contacts"] = array_of<std::int64_t>(patch.contacts);
    fields["point"] = array_of<double>(patch.point);
    fields["normal"] = array_of<double>(patch.normal);
    fields["depth"] = patch.depth;
    fields["length"] = patch.length;
    patches.append(fields);
  }
  return patches;
}

/// The pair of a frame that `pickle` has kept by its two ids; without contacts if the frame has none.
Python_pair pair_of_state(const py::tuple& state) {
  const bool is_pair = state.size() == 3 && py::isinstance<Python_frame>(state[0]) &&
                       py::isinstance<py::int_>(state[1]) && py::isinstance<py::int_>(state[2]);
  if (!is_pair) throw Bad_saved_object("this is no pickled pair");
  const auto a = state[1].cast<Object_id>(), b = state[2].cast<Object_id>();
  const Pair_result* const result = state[0].cast<const Python_frame&>().frame->find(a, b);
  return {state[0], result != nullptr ? *result : Pair_result{.a = a, .b = b}};
}

py::object candidates_of(const Python_frame& self) {
  py::list candidates;
  for (const auto& c : self.frame->candidates)
    candidates.append(py::make_tuple(c.a, c.region_a, c.b, c.region_b, c.distance));
  return candidates;
}

/// The rows of a frame's array that belong to a pair; None stays None.
py::object slice_of(const Python_pair& self, const char* name) {
  py::object all = self.frame.attr(name);
  if (all.is_none()) return all;
  const auto first = self.result.first_contact;
  return all[py::slice(static_cast<py::ssize_t>(first), static_cast<py::ssize_t>(first + self.result.contacts), 1)];
}

const char* containment_of(const Pair_result& result) {
  if (result.containment == Containment::a_in_b) return "a_in_b";
  return result.containment == Containment::b_in_a ? "b_in_a" : "none";
}

std::string text_of_frame(const Python_frame& self) {
  std::ostringstream text;
  text << "<lodestone.Frame " << self.frame->number << ": " << self.frame->pairs.size() << " pairs, "
       << (self.frame->collides() ? "collides" : "does not collide") << ", " << self.frame->face_pairs.size()
       << " contacts>";
  return text.str();
}

std::string text_of_pair(const Python_pair& self) {
  const auto& pair = self.result;
  std::ostringstream text;
  text << "<lodestone.Pair " << pair.a << ", " << pair.b << ": " << (pair.collides ? "collides" : "does not collide")
       << ", " << pair.contacts << " contacts>";
  return text.str();
}

}  // namespace

py::dict statistics_of(const Frame_statistics& s) {
  py::dict seconds;
  seconds["build"] = s.seconds.build;
  seconds["repartition"] = s.seconds.repartition;
  seconds["refit"] = s.seconds.refit;
  seconds["broad_phase"] = s.seconds.broad_phase;
  seconds["relaxation"] = s.seconds.relaxation;
  seconds["candidates"] = s.seconds.candidates;
  seconds["confirmation"] = s.seconds.confirmation;
  py::dict all;
  all["seconds"] = seconds;
  all["object_candidates"] = s.object_candidates;
  all["iterations"] = s.iterations;
  all["moves"] = s.moves;
  all["relaxed"] = s.relaxed;
  all["meetings"] = s.meetings;
  all["vertices_read"] = s.vertices_read;
  all["nodes_bounded"] = s.nodes_bounded;
  all["leaves_posed"] = s.leaves_posed;
  all["violations"] = s.violations;
  all["candidates"] = s.candidates;
  all["leaf_tests"] = s.leaf_tests;
  all["exact_tests"] = s.exact_tests;
  all["contacts"] = s.contacts;
  all["builds"] = s.builds;
  all["repartitions"] = s.repartitions;
  return all;
}

py::object only_pair(Python_frame frame) {
  const Pair_result result = frame.frame->pairs.empty() ? Pair_result{.a = 0, .b = 1} : frame.frame->pairs.front();
  return py::cast(Python_pair{py::cast(std::move(frame)), result});
}

namespace {

void add_frame_class(py::module_& module) {
  py::class_<Python_frame>(module, "Frame", py::dynamic_attr(),
                           "What `Detector.detect` found. It stays as it is when the detector goes on.")
      .def_property_readonly("number", [](const Python_frame& self) { return self.frame->number; },
                             "Number of the frame: counts from 1, and skips numbers that failed frames have used.")
      .def_readonly("detector", &Python_frame::detector,
                    "The detector that found it; None: a function did, or the frame was pickled or copied.")
      .def_property_readonly("collides", [](const Python_frame& self) { return self.frame->collides(); },
                             "Whether any two faces intersect; `bool(frame)` is the same.")
      .def_property_readonly("near", [](const Python_frame& self) { return self.frame->near(); },
                             "Whether any two faces are nearer than the tolerance; False without one.")
      .def_property_readonly("capped", [](const Python_frame& self) { return self.frame->capped(); },
                             "Whether contacts are missing because of `most_contacts`.")
      .def_property_readonly("unfinished", [](const Python_frame& self) { return self.frame->unfinished(); },
                             "Whether the budget of openings ended the search of a pair.")
      .def_property_readonly(
          "pairs", pairs_of_frame,  // not kept: a pair holds its frame, and neither would ever be freed
          "The object pairs that the broad phase, groups and `ignore` let pass, or the pair that was asked for, in the\n"
          "order of (a, b): a tuple of `Pair`, made anew each time.")
      .def_property_readonly(
          "faces", [](const py::object& self) { return kept(self, "_faces", faces_of_frame); },
          "Contacts of all pairs, one pair after the other: (k, 2) int64, a face of a and one of b per row. With a\n"
          "tolerance those that intersect and those that are only near: see `intersects`.")
      .def_property_readonly(
          "intersects", [](const py::object& self) { return kept(self, "_intersects", intersects_of_frame); },
          "Whether the two faces of a contact intersect: (k,) bool. False where they are nearer than the tolerance, but\n"
          "apart.")
      .def_property_readonly(
          "points", [](const py::object& self) { return kept(self, "_points", points_of_frame); },
          "The middle of where two faces meet: (k, 3) float64, in units of the coordinates.\nNone unless "
          "`contact_points` was asked for.")
      .def_property_readonly(
          "segments", [](const py::object& self) { return kept(self, "_segments", segments_of_frame); },
          "The ends of the segment in which two faces meet: (k, 2, 3) float64; equal ends where it is a point.\nOf two "
          "coplanar faces: the corners of their common polygon that are farthest apart. Of two faces that are\nnear but "
          "apart: the nearest point of each. None unless `contact_points` was asked for.")
      .def_property_readonly(
          "normals", [](const py::object& self) { return kept(self, "_normals", normals_of_frame); },
          "A direction in which face a and face b part: (k, 3) float64 unit vectors, from b towards a;\n"
          " 0 if neither face has an area. None unless `contact_normals` was asked for.")
      .def_property_readonly(
          "depths", [](const py::object& self) { return kept(self, "_depths", depths_of_frame); },
          "How far to move face a along the normal, so that it touches face b at most, wherever they meet: (k,) float64,\n"
          "in units of the coordinates. The faces may part sooner. Negative where faces are near but apart: minus\n"
          "their distance. None unless `contact_normals` was asked for.")
      .def("outline", outline_of, py::arg("contact"),
           "Where two faces meet: (n, 3) float64, the one corner of a point, the two of a segment or those of a polygon.")
      .def_property_readonly("candidates", candidates_of,
                             "With `list_candidates`, regions that may touch: tuples (object a, region, object b, "
                             "region, distance).")
      .def_property_readonly("statistics", [](const Python_frame& self) { return statistics_of(self.frame->statistics); },
                             "What the frame took: a dict of counts, and of the seconds of each stage.")
      .def("__bool__", [](const Python_frame& self) { return self.frame->collides(); }, "`collides`.")
      .def(py::pickle([](const Python_frame& self) { return pickled(self); }, &unpickled_frame))
      .def("__repr__", text_of_frame);
}

void add_pair_class(py::module_& module) {
  py::class_<Python_pair>(module, "Pair", "What was found about two objects a < b, or about one and itself, a = b.")
      .def_property_readonly("a", [](const Python_pair& self) { return self.result.a; }, "Id of the first object.")
      .def_property_readonly("b", [](const Python_pair& self) { return self.result.b; }, "Id of the second object.")
      .def_property_readonly("frame", [](const Python_pair& self) { return self.frame; }, "The frame it is of.")
      .def_property_readonly("collides", [](const Python_pair& self) { return self.result.collides; },
                             "Whether two faces intersect; `bool(pair)` is the same.")
      .def_property_readonly("near", [](const Python_pair& self) { return self.result.near; },
                             "Whether two faces are nearer than the tolerance, or intersect; False without one.")
      .def_property_readonly("capped", [](const Python_pair& self) { return self.result.capped; },
                             "Whether contacts are missing because of `most_contacts`.")
      .def_property_readonly("unfinished", [](const Python_pair& self) { return self.result.unfinished; },
                             "Whether the budget of openings ended the search, so that contacts can be missing. Mode\n"
                             "`particles`.")
      .def_property_readonly("containment", [](const Python_pair& self) { return containment_of(self.result); },
                             "'a_in_b' or 'b_in_a' if one object lies inside the other, else 'none'. With the option\n"
                             "`containment`.")
      .def_property_readonly(
          "parting",
          [](const Python_pair& self) -> py::object {
            if (!self.result.parting) return py::none();
            return array_of<double>(self.result.parting->translation);
          },
          "A translation of a that parts the two: (3,) float64. None unless asked for with `parting`, and needed.")
      .def_property_readonly("patches", patches_of_pair,
                             "Contact patches, with the option `patches`: a list of dicts with contacts (rows of "
                             "`faces`), point, normal,\ndepth and length.")
      .def_property_readonly("faces", [](const Python_pair& self) { return slice_of(self, "faces"); },
                             "Faces of a and b in contact: (k, 2) int64. As `Frame.faces`, of this pair.")
      .def_property_readonly("intersects", [](const Python_pair& self) { return slice_of(self, "intersects"); },
                             "As `Frame.intersects`, of this pair.")
      .def_property_readonly("points", [](const Python_pair& self) { return slice_of(self, "points"); },
                             "As `Frame.points`, of this pair.")
      .def_property_readonly("segments", [](const Python_pair& self) { return slice_of(self, "segments"); },
                             "As `Frame.segments`, of this pair.")
      .def_property_readonly("normals", [](const Python_pair& self) { return slice_of(self, "normals"); },
                             "As `Frame.normals`, of this pair.")
      .def_property_readonly("depths", [](const Python_pair& self) { return slice_of(self, "depths"); },
                             "As `Frame.depths`, of this pair.")
      .def_property_readonly("statistics", [](const Python_pair& self) { return self.frame.attr("statistics"); },
                             "As `Frame.statistics`: of the whole frame.")
      .def("__bool__", [](const Python_pair& self) { return self.result.collides; }, "`collides`.")
      .def(py::pickle(
          [](const Python_pair& self) { return py::make_tuple(self.frame, self.result.a, self.result.b); },
          &pair_of_state))
      .def("__repr__", text_of_pair);
}

}  // namespace

void add_frames(py::module_& module) {
  add_frame_class(module);
  add_pair_class(module);
}

}  // namespace lodestone::python
