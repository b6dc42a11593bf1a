// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/scenes/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <system_error>
#include <utility>

#include "io/files/json_reader.h"
#include "io/files/small_text.h"
#include "io/motion/keep_joined.h"
#include "io/motion/mesh_sequence.h"
#include "io/scenes/face_count.h"
#include "io/scenes/object_of.h"
#include "io/scenes/scene_fields.h"
#include "io/scenes/scene_folder.h"
#include "io/scenes/scene_groups.h"
#include "io/scenes/shared_clock.h"
#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/io/motion/computed_motion.h"
#include "lodestone/io/motion/deformation.h"
#include "lodestone/mesh/errors.h"
#include "mesh/is_finite.h"

namespace lodestone {

namespace {

using detail::as_json;
using detail::Json_value;
using detail::object_of;
using detail::Scene_folder;
using Placement = std::optional<Kernel::Aff_transformation_3>;

constexpr std::size_t most_ignored = 100'000;
constexpr std::size_t most_animations = 10'000;
constexpr std::size_t most_particles = 100'000;

// ---- Meshes ----

/// An object without motion, and where its faces come from.
struct Object_at_rest {
  Scene_object object;
  std::filesystem::path mesh = {};  ///< empty: a shape
  Joined_vertices joined = {};
};

Object_at_rest read_rest(const Json_value& value, Scene_folder& folder) {
  if (value.exactly_one_of({"mesh", "shape"}) == "shape") return {object_of(detail::read_shape(value.at("shape")))};
  const Json_value mesh = value.at("mesh");
  const auto file = folder.file(mesh);
  auto read = mesh.from_files([&] { return read_mesh(file, folder.limits()); });
  auto joined = std::move(read.joined);
  return {.object = object_of(std::move(read)), .mesh = file, .joined = std::move(joined)};
}

/// Positions in file order. Vertices that no face uses are not in the mesh: they get the position of the first vertex,
/// which does not affect the bounding box. Joined vertices are where the one is that stands for them.
std::vector<Point> rest_positions(const Scene_object& object, const Joined_vertices& joined) {
  const auto& mesh = object.mesh;
  if (mesh.is_empty()) return std::vector<Point>(object.file_vertices, Point(0, 0, 0));
  std::vector<Point> positions(object.file_vertices, mesh.point(*mesh.vertices().begin()));
  for (const auto v : mesh.vertices()) positions[object.file_vertex[v]] = mesh.point(v);
  for (std::size_t vertex = 0; vertex < joined.size(); ++vertex) positions[vertex] = positions[joined[vertex]];
  return positions;
}

std::vector<Face_corners> faces_of(const Scene_object& object) {
  std::vector<Face_corners> faces;
  for (const auto f : object.mesh.faces()) {
    const std::size_t i = f.idx();
    if (i == 0 || object.file_face[i - 1] != object.file_face[i]) faces.emplace_back();
    ++faces.back().triangles;
    for (const auto v : object.mesh.vertices_around_face(object.mesh.halfedge(f)))
      faces.back().vertices.push_back(object.file_vertex[v]);
  }
  return faces;
}

void place_mesh(Surface_mesh& mesh, const Json_value& value, const Placement& placement) {
  for (const auto v : mesh.vertices()) {
    mesh.point(v) = mesh.point(v).transform(*placement);
    if (!is_finite(mesh.point(v))) value.fail("moves a vertex to a non-finite position");
  }
}

// ---- Motion ----

Motion placed(Motion motion, const Placement& placement) {
  if (!placement) return motion;
  motion.pose = [inner = std::move(motion.pose), transformation = *placement](std::size_t frame,
                                                                              std::span<Point> positions) {
    inner(frame, positions);
    for (Point& p : positions) p = p.transform(transformation);
  };
  if (motion.computed)
    motion.computed = [inner = std::move(motion.computed), placement](std::span<const std::uint32_t> vertices) {
      return placed(inner(vertices), *placement);
    };
  if (motion.resampled)
    motion.resampled = [inner = std::move(motion.resampled), placement](double rate, double start) {
      return placed(inner(rate, start), placement);
    };
  return motion;
}

/// "walk.glb", or {"file": "walk.glb", "animation": "walk", "frames_per_second": 60}.
Motion read_gltf(const Json_value& value, std::size_t vertices, Scene_folder& folder) {
  Gltf_motion_options options{.limits = folder.limits()};
  if (value.is_string()) return read_gltf_motion(folder.file(value), vertices, options);
  value.expect_keys({"file", "animation", "frames_per_second"});
  const auto animation = value.find("animation");
  if (animation) {
    if (animation->is_string())
      options.animation = animation->text();
    else
      options.animation = animation->count(0, most_animations);
  }
  if (const auto rate = value.find("frames_per_second")) {
    options.frames_per_second = rate->number();
    if (!(*options.frames_per_second > 0)) rate->fail("expected a number > 0");
  }
  Motion motion = read_gltf_motion(folder.file(value.at("file")), vertices, options);
  motion.animations.is_chosen = animation.has_value();
  return motion;
}

/// Files with faces must have those of the mesh that they move: else their vertices are in another order.
Motion read_sequence(const Json_value& source, const Object_at_rest& rest, Scene_folder& folder) {
  auto files = folder.sequence(source);
  const std::size_t vertices = rest.object.file_vertices;
  Motion motion = read_mesh_sequence(files, vertices, folder.limits());
  std::error_code ignored;
  if (rest.mesh.empty() || !equivalent(files.front(), rest.mesh, ignored))
    check_faces_of_file(files.front(), {rest.mesh, faces_of(rest.object), rest.joined}, folder.limits());
  return motion;
}

/// Deformations start from the mesh after its placement; positions from files are transformed as they are read.
Motion read_motion(const Json_value& value, const Object_at_rest& rest, const Placement& placement,
                   Scene_folder& folder) {
  const std::string kind = value.expect_one_key({"pc2", "mdd", "gltf", "keyframes", "sequence", "deform"});
  const Json_value source = value.at(kind);
  if (kind == "deform") return deform(rest_positions(rest.object, rest.joined), detail::read_deformations(source));
  const std::size_t vertices = rest.object.file_vertices;
  Motion motion = source.from_files([&] {
    if (kind == "pc2") return read_point_cache(folder.file(source), vertices);
    if (kind == "mdd") return read_mdd_cache(folder.file(source), vertices);
    if (kind == "gltf") return read_gltf(source, vertices, folder);
    if (kind == "keyframes") return read_game_motion(folder.file(source), vertices, folder.limits());
    return read_sequence(source, rest, folder);
  });
  return placed(keep_joined(std::move(motion), rest.joined, rest.mesh), placement);
}

// ---- Objects and scene ----

std::vector<std::filesystem::path> each_once(std::initializer_list<std::vector<std::filesystem::path>> lists) {
  std::vector<std::filesystem::path> files;
  std::set<std::filesystem::path> seen;
  for (const auto& list : lists)
    for (const auto& file : list)
      if (seen.insert(file).second) files.push_back(file);
  return files;
}

Scene_object read_object(const Json_value& value, Scene_folder& folder) {
  value.expect_keys({"name", "mesh", "shape", "place", "motion", "particles", "scattered_side", "groups", "meets"});
  const std::string name = value.at("name").text();
  Object_at_rest rest = read_rest(value, folder);
  Scene_object& object = rest.object;
  object.name = name;
  object.particles = value.count("particles", 1, most_particles, 0);
  if (const auto side = value.find("scattered_side")) object.scattered_side = detail::read_direction(*side);

  Placement placement;
  if (const auto place = value.find("place")) {
    placement = detail::read_placement(*place);
    place_mesh(object.mesh, *place, placement);
  }
  const auto motion = value.find("motion");
  object.motion =
      motion ? read_motion(*motion, rest, placement, folder) : deform(rest_positions(object, rest.joined), {});
  if (!rest.joined.empty()) object.motion.joined = std::move(rest.joined);
  object.ignored_extensions.merge(std::set(object.motion.ignored_extensions));
  object.files = each_once({folder.take_found(), std::move(object.files), object.motion.files});
  return std::move(object);
}

std::vector<Scene_object> read_objects(const Json_value& value, Scene_folder& folder) {
  std::vector<Scene_object> objects;
  std::set<std::string> names;
  detail::Face_count faces(folder.options().max_scene_faces);
  for (const Json_value& element : value.elements(folder.options().max_objects)) {
    objects.push_back(read_object(element, folder));
    if (const auto fault = faces.add(objects.back())) element.fail(*fault);
    const std::string& name = objects.back().name;
    if (!names.insert(name).second)
      element.at("name").fail(fmt::format("{} is taken by an object above", as_json(name)));
  }
  detail::read_groups(value, objects);
  return objects;
}

/// Pairs of names, converted to pairs of object indices.
std::vector<Object_pair> read_ignored(const Json_value& scene, const std::vector<Scene_object>& objects) {
  std::map<std::string, std::uint32_t> numbers;
  for (std::uint32_t o = 0; o < objects.size(); ++o) numbers.emplace(objects[o].name, o);
  const auto number = [&](const Json_value& name) {
    const auto found = numbers.find(name.text());
    if (found == numbers.end()) name.fail(fmt::format("there is no object {}", as_json(name.text())));
    return found->second;
  };
  std::vector<Object_pair> ignored;
  for (const Json_value& pair : scene.list("ignore", most_ignored)) {
    const auto names = pair.elements(2);
    if (names.size() != 2) pair.fail("expected the names of two objects");
    const auto [a, b] = std::minmax({number(names[0]), number(names[1])});
    ignored.push_back({a, b});
  }
  std::ranges::sort(ignored);
  ignored.erase(std::unique(ignored.begin(), ignored.end()), ignored.end());
  return ignored;
}

/// Number of frames of the shortest motion that ends; 0 if none ends.
std::size_t shortest_motion(const std::vector<Scene_object>& objects) {
  std::size_t shortest = 0;
  for (const Scene_object& object : objects) {
    const std::size_t frames = object.motion.frames;
    if (frames != 0) shortest = shortest == 0 ? frames : std::min(shortest, frames);
  }
  return shortest;
}

bool any_moves(const Json_value& objects) {
  return std::ranges::any_of(objects.elements(std::numeric_limits<std::size_t>::max()),  // they have been counted
                             [](const Json_value& object) { return object.has("motion"); });
}

std::size_t read_frames(const Json_value& scene, const std::vector<Scene_object>& objects, std::size_t max_frames) {
  const std::size_t held = shortest_motion(objects);
  const auto frames = scene.find("frames");
  if (!frames) {
    if (held == 0 && any_moves(scene.at("objects"))) scene.fail("missing key \"frames\": no motion ends by itself");
    if (held > max_frames)
      scene.fail(fmt::format("the shortest motion has {} frames, where at most {} are allowed", held, max_frames));
    return std::max<std::size_t>(held, 1);
  }
  const std::size_t asked = frames->count(1, max_frames);
  if (held != 0 && asked > held)
    frames->fail(fmt::format("{} frames are more than the {} of the shortest motion", asked, held));
  return asked;
}

}  // namespace

Scene read_scene(const std::filesystem::path& file, const Scene_options& options) {
  const detail::Json document = detail::parse_json(file);
  const Json_value value(document, file.string());
  value.expect_keys({"name", "description", "frames", "objects", "ignore", "$schema"});
  if (const auto schema = value.find("$schema")) schema->text();  // for editors
  Scene_folder folder(file.has_parent_path() ? file.parent_path() : ".", options);

  Scene scene;
  const auto name = value.find("name");
  scene.name = name ? name->text() : printable(file.stem().string());
  if (const auto description = value.find("description")) scene.description = description->text();
  scene.objects = read_objects(value.at("objects"), folder);
  share_clock(scene.objects);
  scene.ignored = read_ignored(value, scene.objects);
  scene.frames = read_frames(value, scene.objects, options.limits.max_frames);
  return scene;
}

void pose(Scene_object& object, std::size_t frame) {
  std::vector<Point> positions(object.file_vertices);
  object.motion.pose(frame, positions);
  for (const auto v : object.mesh.vertices())
    if (!is_finite(positions[object.file_vertex[v]]))
      throw Bad_motion(fmt::format("{}: frame {}: vertex {} has a non-finite coordinate", object.name, frame,
                                   object.file_vertex[v]));
  for (const auto v : object.mesh.vertices()) object.mesh.point(v) = positions[object.file_vertex[v]];
}

}  // namespace lodestone
