// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "arrays.h"
#include "lodestone/mesh/errors.h"
#include "text.h"

namespace lodestone::python {

namespace {

/// Morph targets from an array of shape (targets, V, 3).
std::vector<Morph_target> targets_of(const py::object& targets, std::size_t vertices) {
  std::vector<Morph_target> list;
  if (targets.is_none()) return list;
  const auto offsets = numbers_of(targets, "targets");
  if (offsets.ndim() != 3 || offsets.shape(2) != 3 || static_cast<std::size_t>(offsets.shape(1)) != vertices)
    throw Bad_argument("targets must have the shape (targets, V, 3), with V vertices");
  for (py::ssize_t target = 0; target < offsets.shape(0); ++target) {
    Morph_target sparse;  // vertices that it does not move are left out
    for (std::uint32_t v = 0; v < vertices; ++v) {
      const double* offset = offsets.data(target, v, 0);
      if (offset[0] == 0 && offset[1] == 0 && offset[2] == 0) continue;
      sparse.vertices.push_back(v);
      sparse.offsets.insert(sparse.offsets.end(), offset, offset + 3);
    }
    list.push_back(std::move(sparse));
  }
  return list;
}

std::shared_ptr<Python_skin> make_skin(const py::object& vertices, const py::object& joints, const py::object& weights,
                                       const py::object& targets, std::size_t joint_count) {
  const auto rest = rows_of(vertices, "vertices");
  const auto influence = numbers_of(weights, "weights");
  const auto listed = py::array::ensure(joints);
  if (!listed || influence.ndim() != 2 || listed.ndim() != 2 || listed.shape(0) != rest.shape(0) ||
      influence.shape(0) != rest.shape(0) || listed.shape(1) != influence.shape(1) || listed.shape(1) == 0)
    throw Bad_argument("joints and weights must both have the shape (V, n), with V vertices and n > 0");
  const auto joint_list = indices_of(listed.attr("reshape")(-1), "joints");
  if (joint_count == 0 && !joint_list.empty()) {
    joint_count = std::size_t{1} + std::ranges::max(joint_list);
    if (joint_count > std::max<std::size_t>(joint_list.size(), 65536))  // such as 2^32 - 1, for none
      throw Bad_argument("joints names joint " + std::to_string(joint_count - 1) + ": if there are so many, give joint_count");
  }
  const auto influences =
      Joint_influences::of(static_cast<std::size_t>(influence.shape(1)), joint_list,
                           std::span(influence.data(), static_cast<std::size_t>(influence.size())));
  std::vector<double> coordinates(rest.data(), rest.data() + rest.size());
  Morphed_points shape(std::move(coordinates), targets_of(targets, static_cast<std::size_t>(rest.shape(0))));
  return std::make_shared<Python_skin>(Skinned_points(std::move(shape), influences, joint_count));
}

void set_joints(Python_skin& skin, const py::object& matrices) {
  const auto numbers = numbers_of(matrices, "matrices");
  if (numbers.ndim() != 3 || numbers.shape(1) != 4 || numbers.shape(2) != 4)
    throw Bad_argument("matrices must have the shape (joints, 4, 4)");
  std::vector<Eigen::Affine3d> joints;
  for (py::ssize_t j = 0; j < numbers.shape(0); ++j) {
    const Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data(j, 0, 0));
    if (!matrix.allFinite()) throw Bad_argument("matrix " + std::to_string(j) + " has a number that is not finite");
    if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
      throw Bad_argument("the last row of matrix " + std::to_string(j) + " must be 0, 0, 0, 1");
    joints.emplace_back(matrix);
  }
  const Without_gil without_gil;
  skin.change([&](Skinned_points& points) { points.set_joints(joints); });
}

void set_weights(Python_skin& skin, const py::object& weights) {
  const auto numbers = numbers_of(weights, "weights");
  const Without_gil without_gil;
  skin.change([&](Skinned_points& points) {
    points.set_weights({numbers.data(), static_cast<std::size_t>(numbers.size())});
  });
}

py::array pose_array(const Python_animation& self, py::ssize_t given) {
  const auto frame = self.frame_of(given);
  if (!frame) throw py::index_error(self.no_frame(given));
  std::vector<double> posed;
  {
    const Without_gil without_gil;
    posed = self.pose(*frame);
  }
  return positions_array(posed);
}

py::list pose_arrays(const Python_animation& self, const py::slice& frames) {
  py::ssize_t start = 0, stop = 0, step = 0, count = 0;
  if (!frames.compute(static_cast<py::ssize_t>(self.frames), &start, &stop, &step, &count))
    throw py::error_already_set();
  py::list poses;
  for (py::ssize_t i = 0; i < count; ++i) poses.append(pose_array(self, start + i * step));
  return poses;
}

void add_animation(py::module_& module) {
  py::class_<Python_animation, std::shared_ptr<Python_animation>>(
      module, "Animation",
      "Triangles whose vertices move, as read from files. `animation[t]` has the positions of frame t, and iteration "
      "gives\nthose of all frames. It can be added to a detector, or given wherever a mesh is asked for: then in its "
      "first frame.")
      .def_property_readonly("name", [](const Python_animation& self) { return text_of(self.name); },
                             "Name of the file, or of the object in its scene.")
      .def_property_readonly("kind", [](const Python_animation& self) { return self.animation->kind; },
                             "mesh, sequence, pc2, mdd, gltf, md2 or md3; object: of a scene.")
      .def_readonly("frames", &Python_animation::frames, "Number of frames.")
      .def_property_readonly("frames_per_second",
                             [](const Python_animation& self) { return self.animation->frames_per_second; },
                             "0: the files do not say.")
      .def_property_readonly("vertices", [](const Python_animation& self) {
        auto positions = pose_array(self, 0);
        positions.attr("flags").attr("writeable") = false;  // it is a copy, so writing to it would move nothing
        return positions;
      }, "Positions of the first frame: (V, 3) float64, in the order of the file. Read-only: to change them, copy them.")
      .def_property_readonly("faces", [](const Python_animation& self) { return faces_array(self.animation->faces); },
                             "(F, 3) int64. Faces of more than three corners are cut into triangles.")
      .def_property_readonly(
          "file_faces", [](const Python_animation& self) { return array_of<std::int64_t>(self.animation->file_face); },
          "Per triangle the face of the file that it is of: (F,) int64.")
      .def_property_readonly("ignored_extensions", [](const Python_animation& self) {
        py::list extensions;
        for (const auto& extension : self.animation->ignored_extensions) extensions.append(extension);
        return extensions;
      }, "Optional extensions of a glTF file that say where surfaces are, and are not read.")
      .def_property_readonly("files", [](const Python_animation& self) {
        py::list files;
        for (const auto& file : self.animation->files) files.append(name_of_file(file));
        return files;
      }, "The files that it is read from.")
      .def("pose", pose_array, py::arg("frame"), "Positions of a frame: (V, 3) float64. -1: the last.")
      .def("__getitem__", pose_array, py::arg("frame"), "Positions of a frame; -1: the last.")
      .def("__getitem__", pose_arrays, py::arg("frames"), "Positions of frames: a list.")
      .def("__len__", [](const Python_animation& self) { return self.frames; })
      .def("__repr__", [](const Python_animation& self) {
        return text_of("<lodestone.Animation " + self.name + ": " + std::to_string(self.animation->vertices) +
                       " vertices, " + std::to_string(self.animation->faces.size()) + " faces, " +
                       std::to_string(self.frames) + " frames>");
      });
}

void add_skin(py::module_& module) {
  py::class_<Python_skin, std::shared_ptr<Python_skin>>(
      module, "Skin",
      "Vertices that joints move: linear blend skinning, after morph targets as in glTF. In mode `certified` a detector\n"
      "computes only those vertices that may be near something.\n\n    skin = lodestone.Skin(vertices, joints, weights)\n"
      "    hand = detector.add(skin, faces)\n    skin.set_joints(matrices)\n    frame = detector.detect()")
      .def(py::init(&make_skin), py::arg("vertices"), py::arg("joints"), py::arg("weights"), py::kw_only(),
           py::arg("targets") = py::none(), py::arg("joint_count") = 0,
           "vertices: (V, 3), at rest. joints: (V, n) int, the joints of each vertex. weights: (V, n), >= 0; those of a\n"
           "vertex are divided by their sum. targets: (targets, V, 3), offsets at weight 1. joint_count: 0: as many as "
           "are listed.")
      .def("set_joints", set_joints, py::arg("matrices"),
           "The motions of all joints, from rest to where they are now: (joints, 4, 4), affine, column vectors.")
      .def("set_weights", set_weights, py::arg("weights"), "The weight of each morph target: (targets,).")
      .def_property_readonly("joint_count", [](const Python_skin& self) { return self.points().joint_count(); },
                             "Number of joints.")
      .def_property_readonly("target_count", [](const Python_skin& self) { return self.points().shape().target_count(); },
                             "Number of morph targets.")
      .def("pose",
           [](const Python_skin& self) {
             std::vector<double> posed;
             {
               const Without_gil without_gil;
               posed = self.pose();
             }
             return positions_array(posed);
           },
           "All positions in the current pose: (V, 3) float64.");
}

}  // namespace

std::optional<std::size_t> Python_animation::frame_of(py::ssize_t number) const {
  const auto frame = number < 0 ? number + static_cast<py::ssize_t>(frames) : number;
  if (frame < 0 || static_cast<std::size_t>(frame) >= frames) return std::nullopt;
  return static_cast<std::size_t>(frame);
}

std::string Python_animation::no_frame(py::ssize_t number) const {
  return "there is no frame " + std::to_string(number) + ": there are " + std::to_string(frames);
}

std::vector<double> Python_animation::pose(std::size_t frame) const {
  std::vector<Point> points(animation->vertices);
  animation->motion.pose(frame, points);
  std::vector<double> coordinates;
  coordinates.reserve(3 * points.size());
  for (const auto& p : points) coordinates.insert(coordinates.end(), {p.x(), p.y(), p.z()});
  return coordinates;
}

std::vector<double> Python_skin::pose() const {
  const std::lock_guard lock(mutex_);
  std::vector<double> coordinates(3 * std::size_t{points_.vertex_count()});
  points_.pose_all(coordinates);
  return coordinates;
}

void add_motions(py::module_& module) {
  add_animation(module);
  add_skin(module);
}

}  // namespace lodestone::python
