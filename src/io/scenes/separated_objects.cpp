// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/scenes/separated_objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "io/files/json_reader.h"
#include "io/files/small_text.h"
#include "io/files/unique_names.h"
#include "io/scenes/object_of.h"
#include "io/scenes/scene_folder.h"
#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/io/motion/computed_motion.h"
#include "lodestone/mesh/components.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

/// Each takes some hundred bytes, here and in the detector.
constexpr std::size_t most_ignored_parts = 1'000'000;

/// Some faces of an object. Their corners are numbered among them.
struct Separated_faces {
  std::string name;  ///< of the object that they become
  std::vector<Point> points = {};
  std::vector<std::uint32_t> file_vertex = {};  ///< per point; ascending
  std::vector<Corners> faces = {};
  std::vector<std::uint32_t> file_face = {};  ///< per face
};

/// Which of several objects each face goes to, and their names.
struct Separation {
  std::vector<std::uint32_t> label;  ///< per face
  std::vector<std::string> names;    ///< per label
};

std::vector<Point> file_points(const Scene_object& object) {
  std::vector<Point> points(object.file_vertices);
  for (const auto v : object.mesh.vertices()) points[object.file_vertex[v]] = object.mesh.point(v);
  return points;
}

/// @param of    what has so many things
/// @param hint  what can be done
void check_count(std::size_t count, std::size_t most, const char* things, const std::string& of,
                 const char* hint = "") {
  if (count > most) throw Bad_scene(fmt::format("{}: {} {}; expected at most {}{}", of, count, things, most, hint));
}

Separation by_component(const Scene_object& object, std::span<const Corners> faces, std::size_t max_objects) {
  Separation by{.label = component_of_faces(static_cast<std::uint32_t>(object.file_vertices), faces), .names = {}};
  const std::size_t count = by.label.empty() ? 0 : *std::ranges::max_element(by.label) + std::size_t{1};
  check_count(
      count, max_objects, "connected components", object.name,
      ". Vertices that coincide connect no faces before they are welded, as by lodestone convert --weld 0, if no "
      "frame moves them apart");
  for (std::size_t number = 1; number <= count; ++number) by.names.push_back(fmt::format("{}_{}", object.name, number));
  return by;
}

Separation by_part(const Scene_object& object, std::size_t max_objects) {
  Separation by;
  std::map<std::string, std::uint32_t> labels;
  for (const auto face : object.file_face) {
    const auto after = std::ranges::upper_bound(object.parts, face, {}, &File_part::first_face);
    const std::string& name = after == object.parts.begin() ? std::string() : std::prev(after)->name;
    const auto [label, is_new] = labels.try_emplace(name, static_cast<std::uint32_t>(labels.size()));
    if (is_new) by.names.push_back(name.empty() ? object.name : detail::valid_utf8(printable(name)));
    by.label.push_back(label->second);
  }
  check_count(by.names.size(), max_objects, "parts", object.name);
  return by;
}

std::vector<Separated_faces> separated_faces(const Scene_object& object, std::span<const Corners> faces,
                                             const Separation& by) {
  std::vector<Separated_faces> separated;
  for (const auto& name : by.names) separated.push_back({.name = name});
  for (std::size_t f = 0; f < faces.size(); ++f) {
    auto& some = separated[by.label[f]];
    some.faces.push_back(faces[f]);
    some.file_face.push_back(object.file_face[f]);
  }
  const auto points = file_points(object);
  std::vector<std::uint32_t> number(points.size());
  for (auto& some : separated) {
    auto& vertices = some.file_vertex;
    for (const auto& corners : some.faces) vertices.insert(vertices.end(), corners.begin(), corners.end());
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
      number[vertices[v]] = v;
      some.points.push_back(points[vertices[v]]);
    }
    for (auto& corners : some.faces)
      for (auto& corner : corners) corner = number[corner];
  }
  return separated;
}

/// The positions of a whole in the frame that was asked for last.
class Whole_pose {
 public:
  Whole_pose(std::function<void(std::size_t, std::span<Point>)> pose, std::size_t vertices)
      : pose_(std::move(pose)), points_(vertices) {}

  void write(std::size_t frame, std::span<const std::uint32_t> vertices, std::span<Point> positions) {
    const std::lock_guard lock(mutex_);
    if (frame_ != frame) {
      frame_.reset();  // posing may throw
      pose_(frame, points_);
      frame_ = frame;
    }
    for (std::size_t v = 0; v < vertices.size(); ++v) positions[v] = points_[vertices[v]];
  }

 private:
  std::mutex mutex_;
  std::function<void(std::size_t, std::span<Point>)> pose_;
  std::vector<Point> points_;
  std::optional<std::size_t> frame_;
};

/// The motion of some vertices of a whole.
Motion motion_of(const Motion& whole, const std::shared_ptr<Whole_pose>& pose,
                 const std::vector<std::uint32_t>& vertices) {
  Motion motion = whole;
  motion.resampled = {};  // the scene has chosen its frames
  motion.joined = {};     // is of the vertices of the whole
  motion.pose = [pose, vertices](std::size_t frame, std::span<Point> positions) {
    pose->write(frame, vertices, positions);
  };
  if (whole.computed)
    motion.computed = [inner = whole.computed, vertices](std::span<const std::uint32_t> some) {
      std::vector<std::uint32_t> of_whole(some.size());
      std::ranges::transform(some, of_whole.begin(), [&](std::uint32_t vertex) { return vertices[vertex]; });
      return inner(of_whole);
    };
  return motion;
}

Scene_object object_of(Separated_faces some, const Scene_object& whole, const std::shared_ptr<Whole_pose>& pose) {
  auto built = mesh_of(some.points, some.faces, some.name);
  return {.name = std::move(some.name),
          .mesh = std::move(built.mesh),
          .file_vertex = std::move(built.file_vertex),
          .file_vertices = some.points.size(),
          .file_face = std::move(some.file_face),
          .parts = whole.parts,
          .ignored_extensions = whole.ignored_extensions,
          .motion = motion_of(whole.motion, pose, some.file_vertex),
          .particles = whole.particles,
          .collision = whole.collision,
          .scattered_side = whole.scattered_side,
          .files = whole.files};
}

/// Pairs of objects, as pairs of what is now in the place of each. No pair is of one object, if that has several parts.
/// @param parts  per object
std::vector<Object_pair> pairs_of_parts(std::span<const Object_pair> pairs, std::span<const std::size_t> parts) {
  std::vector<std::uint32_t> first{0};
  for (const std::size_t count : parts) first.push_back(first.back() + static_cast<std::uint32_t>(count));
  std::vector<Object_pair> of_parts;
  for (const auto& [a, b] : pairs) {
    check_count(of_parts.size() + parts[a] * parts[b], most_ignored_parts, "ignored pairs", "the parts of objects");
    for (auto i = first[a]; i < first[a + 1]; ++i)
      for (auto j = first[b]; j < first[b + 1]; ++j) of_parts.push_back({i, j});
  }
  std::ranges::sort(of_parts);
  return of_parts;
}

/// Names that differ: first of the objects that stay, then of the others.
/// @param wholes  the names of the objects that were separated
void give_names(std::span<std::vector<Scene_object>> separated, std::span<const std::string> wholes, Separate what) {
  Unique_names names;
  for (auto& objects : separated)
    if (objects.size() == 1) objects[0].name = names.take(objects[0].name);
  for (std::size_t whole = 0; whole < separated.size(); ++whole) {
    auto& objects = separated[whole];
    if (objects.size() == 1) continue;
    if (what == Separate::parts) {
      for (auto& object : objects) object.name = names.take(object.name);
      continue;
    }
    const auto name = names.take_numbered(wholes[whole], objects.size());
    for (std::size_t i = 0; i < objects.size(); ++i) objects[i].name = Unique_names::numbered(name, i + 1);
  }
}

}  // namespace

std::vector<Scene_object> separated_objects(const Scene_object& object, Separate what, std::size_t max_objects) {
  const auto faces = detail::file_corners(object);
  const auto by = what == Separate::parts ? by_part(object, max_objects) : by_component(object, faces, max_objects);
  const auto pose = std::make_shared<Whole_pose>(object.motion.pose, object.file_vertices);
  std::vector<Scene_object> objects;
  for (auto& some : separated_faces(object, faces, by)) objects.push_back(object_of(std::move(some), object, pose));
  return objects;
}

void separate(Scene& scene, Separate what, std::size_t max_objects) {
  std::vector<std::vector<Scene_object>> separated;
  std::vector<std::string> wholes;
  std::vector<std::size_t> parts;
  std::size_t count = 0;
  for (std::uint32_t o = 0; o < scene.objects.size(); ++o) {
    auto& objects = separated.emplace_back();
    wholes.push_back(scene.objects[o].name);
    if (!scene.ignores({o, o})) objects = separated_objects(scene.objects[o], what, max_objects);
    if (objects.size() <= 1) {
      objects.clear();
      objects.push_back(std::move(scene.objects[o]));
    }
    parts.push_back(objects.size());
    check_count(count += objects.size(), max_objects, "objects", scene.name);
  }
  give_names(separated, wholes, what);
  scene.ignored = pairs_of_parts(scene.ignored, parts);
  scene.objects.clear();
  for (auto& objects : separated) std::ranges::move(objects, std::back_inserter(scene.objects));
}

}  // namespace lodestone
