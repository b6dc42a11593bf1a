// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <optional>
#include <variant>
#include <vector>

#include "arrays.h"
#include "io/files/small_text.h"
#include "lodestone/io/motion/animation.h"
#include "lodestone/io/results/animation_output.h"
#include "lodestone/io/scenes/given_objects.h"
#include "lodestone/io/scenes/object_options.h"
#include "lodestone/io/scenes/separated_objects.h"
#include "lodestone/mesh/check_finite.h"
#include "lodestone/mesh/errors.h"
#include "motion.h"
#include "options.h"
#include "text.h"

/// Reading and writing meshes, animations and scenes.
namespace lodestone::python {

namespace {

using Path = std::filesystem::path;

/// Scenes, their objects and built-in shapes are no files of this kind.
void refuse_scenes(const Path& path) {
  const auto name = lower_case(path.string());
  if (name.starts_with("shape:") || name.ends_with(".json") || name.find(".json#") != std::string::npos)
    throw Bad_argument(path.string() + ": scenes, their objects and shapes are read by read_scene");
}

/// Only glTF files have several animations, and times between frames.
void check_used(const Path& path, const Animation& read, const std::variant<std::size_t, std::string>& animation,
                const std::optional<double>& frames_per_second) {
  if (frames_per_second && !(*frames_per_second > 0 && std::isfinite(*frames_per_second)))
    throw Bad_argument("frames_per_second must be finite and > 0");
  const bool chosen = animation != std::variant<std::size_t, std::string>(std::size_t{0});
  if (read.kind != "gltf" && (chosen || frames_per_second))
    throw Bad_argument(path.string() + ": animation and frames_per_second are for glTF files");
  if (chosen && read.motion.animations.names.empty())
    throw Bad_argument(path.string() + ": the file has no animations");
}

std::shared_ptr<Python_animation> read_animation_file(const Path& path, const std::optional<Path>& mesh,
                                                      const std::variant<std::size_t, std::string>& animation,
                                                      std::optional<double> frames_per_second, std::size_t max_faces,
                                                      std::uintmax_t max_bytes, std::size_t max_frames) {
  refuse_scenes(path);
  const Without_gil without_gil;
  auto read = std::make_shared<Animation>(read_animation(path, {.mesh = mesh.value_or(Path()),
                                                                .frames_per_second = frames_per_second,
                                                                .animation = animation,
                                                                .limits = {max_faces, max_bytes, max_frames}}));
  check_used(path, *read, animation, frames_per_second);
  return std::make_shared<Python_animation>(
      Python_animation{.name = path.filename().string(), .animation = read, .frames = read->motion.frames});
}

/// A mesh file is an animation of one frame.
std::shared_ptr<Python_animation> read_mesh_file(const Path& path, std::size_t max_faces, std::uintmax_t max_bytes) {
  auto mesh = read_animation_file(path, {}, std::size_t{0}, {}, max_faces, max_bytes, Mesh_file_options().max_frames);
  if (mesh->animation->faces.empty()) throw Bad_mesh(path.string() + ": a point cache has no faces");
  return mesh;
}

/// What a scene says of an object, without what its animation knows.
Object_options scene_options(const Scene_object& object) {
  Object_options options = object_options(object);
  options.file_vertex = {};
  return options;
}

/// A scene of animations.
struct Python_scene {
  std::string name, description;
  std::size_t frames = 0;
  std::vector<std::shared_ptr<Python_animation>> objects = {};
  std::vector<Object_pair> ignored = {};
};

Python_scene read_scene_file(const std::variant<Path, std::vector<Path>>& path, bool components, bool parts,
                             bool allow_outside, std::size_t max_faces, std::uintmax_t max_bytes,
                             std::size_t max_frames, std::size_t max_objects, std::size_t max_scene_faces) {
  const Without_gil without_gil;
  const auto* const one = std::get_if<Path>(&path);
  const auto inputs = one != nullptr ? std::vector{*one} : std::get<std::vector<Path>>(path);
  if (inputs.empty()) throw Bad_argument("expected at least one path");
  Scene scene = read_inputs(inputs, {.allow_outside = allow_outside,
                                     .limits = {max_faces, max_bytes, max_frames},
                                     .max_objects = max_objects,
                                     .max_scene_faces = max_scene_faces});
  if (parts) separate(scene, Separate::parts, max_objects);
  if (components) separate(scene, Separate::components, max_objects);
  Python_scene read{.name = scene.name, .description = scene.description, .frames = scene.frames};
  for (const auto& object : scene.objects)
    read.objects.push_back(std::make_shared<Python_animation>(
        Python_animation{.name = object.name,
                         .animation = std::make_shared<Animation>(animation_of(object, scene.frames)),
                         .frames = scene.frames,
                         .options = scene_options(object)}));
  read.ignored = scene.ignored;
  return read;
}

const Object_options& at(const Python_scene& scene, std::size_t object) {
  if (object >= scene.objects.size()) throw py::index_error("there is no object " + std::to_string(object));
  return scene.objects[object]->options;
}

py::dict options_of(const Python_scene& scene, std::size_t object) {
  const Object_options& options = at(scene, object);
  py::dict all;
  all["groups"] = options.groups;
  all["meets"] = options.meets;
  all["particles"] = options.particles;
  all["scattered_side"] = options.scattered_side ? py::object(array_of<double>(*options.scattered_side)) : py::none();
  return all;
}

using Frames = std::vector<std::vector<double>>;

/// The vertices of a mesh or of a frame to be written, as doubles.
/// @param frame  its name; empty: they are the only ones
std::vector<double> coordinates_of(const py::object& vertices, const std::string& frame = {}) {
  const auto rows = rows_of(vertices, frame.empty() ? "vertices" : frame);
  std::vector<double> coordinates(rows.data(), rows.data() + rows.size());
  check_finite(coordinates, frame);
  return coordinates;
}

/// The frames of an animation to be written.
Frames frames_of(const py::object& frames) {
  Frames all;
  for (const auto& frame : frames) {
    const std::string name = "frame " + std::to_string(all.size());
    all.push_back(coordinates_of(py::reinterpret_borrow<py::object>(frame), name));
    if (all.back().size() != all.front().size())
      throw Bad_argument(name + " has another number of vertices than frame 0");
  }
  if (all.empty()) throw Bad_argument("there are no frames");
  return all;
}

/// Faces of these vertices; None: no faces.
std::vector<Corners> written_faces(const py::object& faces, std::size_t vertices) {
  if (faces.is_none()) return {};
  auto all = faces_of(faces);
  for (std::size_t face = 0; face < all.size(); ++face)
    for (const auto corner : all[face])
      if (corner >= vertices)
        throw Bad_mesh("face " + std::to_string(face) + " refers to vertex " + std::to_string(corner) + " of " +
                       std::to_string(vertices));
  return all;
}

void write(const Path& path, const Frames& coordinates, const py::object& faces,
           const Animation_output_options& options) {
  Animation animation{.kind = "array"};
  animation.vertices = coordinates.front().size() / 3;
  animation.faces = naming_mesh(path.string(), [&] { return written_faces(faces, animation.vertices); });
  animation.motion.frames = coordinates.size();
  animation.motion.pose = [&coordinates](std::size_t frame, std::span<Point> positions) {
    for (std::size_t v = 0; v < positions.size(); ++v) {
      const double* p = coordinates[frame].data() + 3 * v;
      positions[v] = Point(p[0], p[1], p[2]);
    }
  };
  for (std::uint32_t f = 0; f < animation.faces.size(); ++f) animation.file_face.push_back(f);
  const Without_gil without_gil;
  write_animation(path, animation, options);
}

void write_animation_file(const Path& path, const py::object& frames, const py::object& faces,
                          std::optional<double> frames_per_second) {
  // Those of an Animation, unless the caller gives others.
  const py::object given = faces.is_none() ? py::getattr(frames, "faces", py::none()) : faces;
  const Frames coordinates = naming_mesh(path.string(), [&] { return frames_of(frames); });
  if (!py::isinstance<Python_animation>(frames))
    return write(path, coordinates, given, {.frames_per_second = frames_per_second.value_or(usual_rate)});
  const Animation& read = *frames.cast<const Python_animation&>().animation;
  const double rate = frames_per_second.value_or(read.frames_per_second > 0 ? read.frames_per_second : usual_rate);
  const bool is_positive = rate > 0 && std::isfinite(rate);  // write_animation refuses others
  write(path, coordinates, given,
        {.frames_per_second = rate, .start = is_positive ? start_at(read.motion, rate) : 0});
}

void write_mesh_file(const Path& path, const py::object& mesh, const py::object& faces) {
  const auto given = given_mesh(mesh, faces, "mesh");
  if (const auto kind = lower_case(path.extension().string()); kind == ".pc2" || kind == ".mdd")
    throw Bad_argument(path.string() + ": a point cache has no faces: write it by write_animation");
  const Frames only{naming_mesh(path.string(), [&] { return coordinates_of(given.vertices); })};
  write(path, only, given.faces, {.numbered = false});
}

}  // namespace

void add_files(py::module_& module) {
  const Scene_options usual;
  const Mesh_file_options& limits = usual.limits;
  module.def("read_mesh", read_mesh_file, py::arg("path"), py::kw_only(), py::arg("max_faces") = limits.max_faces,
             py::arg("max_bytes") = limits.max_bytes,
             "Reads a mesh: OFF, OBJ, PLY, STL, glTF, MD2, MD3. An Animation, whose `vertices` are those of the first "
             "frame, of a glTF file with\nanimations of the first one.\nmax_faces, max_bytes: a file with more is refused. Raises BadMesh, with file, line and cause.");
  module.def("read_animation", read_animation_file, py::arg("path"), py::kw_only(), py::arg("mesh") = py::none(),
             py::arg("animation") = std::size_t{0}, py::arg("frames_per_second") = py::none(),
             py::arg("max_faces") = limits.max_faces, py::arg("max_bytes") = limits.max_bytes,
             py::arg("max_frames") = limits.max_frames,
             "Reads an animation: a pattern of mesh files such as 'cloth_*.obj', a point cache (.pc2, .mdd) with its `mesh`, "
             "glTF,\nMD2, MD3, or a mesh. animation: index or name in a glTF file. frames_per_second: of a glTF animation.\n"
             "max_faces, max_bytes, max_frames: a file with more is refused; the bytes of a point cache do not count. Raises BadMesh,\n"
             "BadMotion.");
  module.def("write_mesh", write_mesh_file, py::arg("path"), py::arg("mesh"), py::arg("faces") = py::none(),
             "Writes a mesh: .obj, .off, .ply, .stl, .gltf or .glb. The file appears whole or not at all.\n"
             "mesh: vertices, an array (V, 3), with `faces`; or an object that has both.");
  module.def("write_animation", write_animation_file, py::arg("path"), py::arg("frames"), py::arg("faces") = py::none(), py::kw_only(),
             py::arg("frames_per_second") = py::none(),
             "Writes an animation: a point cache (.pc2, .mdd), glTF (.gltf, .glb), or a pattern of mesh files such as "
             "'cloth_####.ply'.\nframes: arrays (V, 3), one per frame, or an Animation. faces: (F, 3), or those of the Animation; a "
             "point cache has none.\nframes_per_second: None means those of the Animation, if it has any, else 30.");

  py::class_<Python_scene>(module, "Scene", "What a scene file describes: objects that move.")
      .def_property_readonly("name", [](const Python_scene& self) { return text_of(self.name); }, "Its name.")
      .def_property_readonly("description", [](const Python_scene& self) { return text_of(self.description); },
                             "What it is about.")
      .def_readonly("frames", &Python_scene::frames, "Number of frames.")
      .def_readonly("objects", &Python_scene::objects, "Its objects: a list of `Animation`.")
      .def_property_readonly("ignored", [](const Python_scene& self) {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
        for (const auto& pair : self.ignored) pairs.emplace_back(pair.a, pair.b);
        return pairs;
      }, "Pairs of objects that are left out.")
      .def("groups", [](const Python_scene& self, std::size_t object) {
        const Object_options& options = at(self, object);
        return std::pair(options.groups, options.meets);
      }, py::arg("object"), "The collision groups of an object: (groups, meets), for `Detector.add`.")
      .def("options", options_of, py::arg("object"),
           "What the scene says of an object: a dict with groups, meets, particles and scattered_side, for\n"
           "`Detector.add(scene.objects[i], **scene.options(i))`.")
      .def("__repr__", [](const Python_scene& self) {
        return text_of("<lodestone.Scene " + self.name + ": " + std::to_string(self.objects.size()) + " objects, " +
                       std::to_string(self.frames) + " frames>");
      });
  module.def("read_scene", read_scene_file, py::arg("path"), py::kw_only(), py::arg("components") = false,
             py::arg("parts") = false, py::arg("allow_outside") = false, py::arg("max_faces") = limits.max_faces,
             py::arg("max_bytes") = limits.max_bytes, py::arg("max_frames") = limits.max_frames,
             py::arg("max_objects") = usual.max_objects, py::arg("max_scene_faces") = usual.max_scene_faces,
             "Reads a scene.\npath: a scene file (.json), or meshes and animations: one path or a list, as the program's `detect` "
             "takes them,\nsuch as 'cloth_*.obj' or 'cloth.obj+cloth.pc2'. components: the connected components of each object "
             "are objects\nof their own, named NAME_1, NAME_2 and so on. parts: so are the objects of an OBJ file and the nodes of a glTF file, "
             "with\nthe names that they have there. allow_outside: a scene may name files outside its folder.\n"
             "max_faces, max_bytes: of each file; max_frames, max_objects, max_scene_faces: of the whole. Raises BadScene, "
             "BadMesh, BadMotion.");
}

}  // namespace lodestone::python
