// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/scenes/component_objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "io/scenes/scene_folder.h"
#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/io/motion/computed_motion.h"
#include "lodestone/mesh/components.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

using detail::most_scene_objects;

/// The faces of one component. Their corners are numbered within the component.
struct Component_faces {
  std::vector<Point> points;
  std::vector<std::uint32_t> file_vertex;  ///< per point
  std::vector<Corners> faces;
  std::vector<std::uint32_t> file_face;  ///< per face
};

/// The corners of all faces, by file vertex.
std::vector<Corners> file_corners(const Scene_object& object) {
  std::vector<Corners> faces;
  faces.reserve(object.mesh.number_of_faces());
  for (const auto f : object.mesh.faces()) {
    auto corner = faces.emplace_back().begin();
    for (const auto v : object.mesh.vertices_around_face(object.mesh.halfedge(f))) *corner++ = object.file_vertex[v];
  }
  return faces;
}

std::vector<Point> file_points(const Scene_object& object) {
  std::vector<Point> points(object.file_vertices);
  for (const auto v : object.mesh.vertices()) points[object.file_vertex[v]] = object.mesh.point(v);
  return points;
}

/// @param of  what has so many components
void check_count(std::size_t count, const std::string& of) {
  if (count > most_scene_objects)
    throw Bad_scene(fmt::format(
        "{}: {} connected components; expected at most {}. Vertices that coincide connect no faces before they are "
        "welded, as by lodestone convert --weld 0",
        of, count, most_scene_objects));
}

std::vector<Component_faces> separated_faces(const Scene_object& object) {
  const auto points = file_points(object);
  const auto faces = file_corners(object);
  const auto component = component_of_faces(static_cast<std::uint32_t>(points.size()), faces);
  const std::size_t count = component.empty() ? 0 : *std::ranges::max_element(component) + std::size_t{1};
  check_count(count, object.name);
  constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> component_of_vertex(points.size(), unused), number(points.size());
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (const auto corner : faces[f]) component_of_vertex[corner] = component[f];
  std::vector<Component_faces> parts(count);
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    if (component_of_vertex[v] == unused) continue;
    auto& part = parts[component_of_vertex[v]];
    number[v] = static_cast<std::uint32_t>(part.points.size());
    part.points.push_back(points[v]);
    part.file_vertex.push_back(v);
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    auto& part = parts[component[f]];
    const auto& [p, q, r] = faces[f];
    part.faces.push_back({number[p], number[q], number[r]});
    part.file_face.push_back(object.file_face[f]);
  }
  return parts;
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

Scene_object object_of(Component_faces part, std::string name, const Scene_object& whole,
                       const std::shared_ptr<Whole_pose>& pose) {
  auto built = mesh_of(part.points, part.faces, name);
  return {.name = std::move(name),
          .mesh = std::move(built.mesh),
          .file_vertex = std::move(built.file_vertex),
          .file_vertices = part.points.size(),
          .file_face = std::move(part.file_face),
          .motion = motion_of(whole.motion, pose, part.file_vertex),
          .particles = whole.particles,
          .collision = whole.collision,
          .scattered_side = whole.scattered_side,
          .files = whole.files};
}

void number_if_taken(std::string& name, const std::set<std::string>& taken) {
  const std::string wanted = name;
  for (std::size_t use = 2; taken.contains(name); ++use) name = fmt::format("{}_{}", wanted, use);
}

/// Pairs of objects, as pairs of what is now in the place of each.
/// @param first  per object the first of its parts; one more: the number of parts
std::vector<Object_pair> pairs_of_parts(std::span<const Object_pair> pairs, std::span<const std::uint32_t> first) {
  std::vector<Object_pair> of_parts;
  for (const auto& [a, b] : pairs)
    for (auto i = first[a]; i < first[a + 1]; ++i)
      for (auto j = a == b ? i : first[b]; j < first[b + 1]; ++j) of_parts.push_back({i, j});
  std::ranges::sort(of_parts);
  return of_parts;
}

}  // namespace

std::vector<Scene_object> component_objects(const Scene_object& object) {
  const auto pose = std::make_shared<Whole_pose>(object.motion.pose, object.file_vertices);
  std::vector<Scene_object> objects;
  for (auto& part : separated_faces(object))
    objects.push_back(object_of(std::move(part), fmt::format("{}_{}", object.name, objects.size() + 1), object, pose));
  return objects;
}

void separate_components(Scene& scene) {
  std::set<std::string> taken;
  for (const auto& object : scene.objects) taken.insert(object.name);
  std::vector<Scene_object> parts;
  std::vector<std::uint32_t> first;
  for (auto& object : scene.objects) {
    first.push_back(static_cast<std::uint32_t>(parts.size()));
    auto components = component_objects(object);
    if (components.size() <= 1) {
      parts.push_back(std::move(object));
      continue;
    }
    for (auto& component : components) {
      number_if_taken(component.name, taken);
      taken.insert(component.name);
      parts.push_back(std::move(component));
    }
    check_count(parts.size(), scene.name);
  }
  first.push_back(static_cast<std::uint32_t>(parts.size()));
  scene.ignored = pairs_of_parts(scene.ignored, first);
  scene.objects = std::move(parts);
}

}  // namespace lodestone
