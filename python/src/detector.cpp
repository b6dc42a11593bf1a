// SPDX-License-Identifier: GPL-3.0-or-later
#include "detector.h"

#include <algorithm>
#include <set>
#include <utility>

#include "lodestone/mesh/errors.h"

namespace lodestone::python {

namespace {

std::vector<Corners> faces_of_animation(const Python_animation& animation) {
  if (animation.animation->faces.empty())
    throw Bad_argument("the animation " + animation.name + " has no faces: a point cache needs its mesh");
  return animation.animation->faces;
}

}  // namespace

Python_object::Python_object(std::string name, const Given_mesh& mesh)
    : name_(std::move(name)),
      faces_(surface_of(mesh.faces)),
      vertices_(std::make_unique<Live_vertices>(mesh.vertices)),
      mesh_(std::make_unique<Indexed_mesh>(vertices_->coordinates(), faces_)) {}

Python_object::Python_object(std::string name, std::shared_ptr<Python_animation> animation, bool on_demand)
    : name_(std::move(name)),
      faces_(faces_of_animation(*animation)),
      animation_(std::move(animation)),
      posed_(animation_->pose(0)),
      mesh_(std::make_unique<Indexed_mesh>(Coordinates(posed_), faces_)) {
  if (!on_demand || !animation_->animation->motion.computed) return;
  std::vector<std::uint32_t> all(num_vertices(*mesh_));
  for (std::uint32_t v = 0; v < all.size(); ++v) all[v] = v;
  computed_ = animation_->animation->motion.computed(all);
  computed_->set_frame(0);  // a computed character is at rest at first, not in frame 0
}

Python_object::Python_object(std::string name, std::shared_ptr<Python_skin> skin, const py::object& faces)
    : name_(std::move(name)),
      faces_(surface_of(faces)),
      skin_(std::move(skin)),
      posed_(skin_->points().shape().rest().begin(), skin_->points().shape().rest().end()),
      mesh_(std::make_unique<Indexed_mesh>(Coordinates(posed_), faces_)) {}

Object_id Python_object::add_to(Detector<Any_strategy>& detector, const Object_options& options) const {
  if (skin_) return detector.add(std::as_const(*mesh_), point_map(*mesh_, skin_->points()), options);
  if (computed_) return detector.add(std::as_const(*mesh_), point_map(*mesh_, *computed_), options);
  return detector.add(*mesh_, options);
}

void Python_object::refresh(std::uint64_t hold) {
  const bool is_read = hold != 0 && std::exchange(read_in_, hold) == hold;
  if (!vertices_) return;
  vertices_->check_memory();
  if (!is_read) vertices_->refresh();
}

void Python_object::check_has_arrays() const {
  if (animation_) throw Bad_argument("its positions come from an animation: use set_frame, or add a copy of its "
                                         "vertices, and its faces, in place of it");
  if (skin_) throw Bad_argument("its positions come from a skin: change its joints or weights");
}

void Python_object::exchange(std::unique_ptr<Live_vertices>& vertices) {
  check_has_arrays();
  if (vertices->count() != num_vertices(*mesh_))
    throw Bad_mesh("there are " + std::to_string(num_vertices(*mesh_)) + " vertices, but got " +
                   std::to_string(vertices->count()) + ": after a change of faces, use rebuild");
  mesh_->set_coordinates(vertices->coordinates());
  std::swap(vertices_, vertices);
}

void Python_object::exchange(std::unique_ptr<Live_vertices>& vertices, std::vector<Corners>& faces) {
  check_has_arrays();
  mesh_->set_arrays(vertices->coordinates(), faces);
  std::swap(vertices_, vertices);
  std::swap(faces_, faces);  // what spans refer to does not move
}

void Python_object::check_changed(std::span<const Corners> faces, std::span<const std::uint32_t> changed) const {
  check_has_arrays();
  const std::size_t common = std::min(faces.size(), faces_.size());
  std::vector<bool> is_listed(common, false);
  for (const std::uint32_t face : changed)
    if (face < common) is_listed[face] = true;
  for (std::size_t face = 0; face < common; ++face)
    if (faces[face] != faces_[face] && !is_listed[face])
      throw Bad_argument("face " + std::to_string(face) + " has other corners than before, but is not listed in changed");
}

void Python_object::set_frame(py::ssize_t number) {
  if (!animation_) throw Bad_argument("it has no animation");
  const auto frame = animation_->frame_of(number);
  if (!frame) throw Bad_argument(animation_->no_frame(number));
  if (computed_) return computed_->set_frame(*frame);
  std::ranges::copy(animation_->pose(*frame), posed_.begin());
}

std::vector<double> Python_object::positions() const {
  std::vector<double> coordinates;
  if (skin_)
    coordinates = skin_->pose();
  else
    coordinates.assign(mesh_->coordinates().begin(), mesh_->coordinates().end());
  if (computed_) computed_->pose_all(coordinates);
  if (!placement_) return coordinates;
  std::vector<double> placed;
  (*placement_)(coordinates, placed);
  return placed;
}

Python_detector::Python_detector(const Detector_settings& settings)
    : settings_(settings),
      detector_(settings.options, settings.strategy.make(settings.strategy_settings)) {}

Python_detector::Reading::Reading(Python_detector& detector) : detector_(detector) {
  detector.check_no_visitor();
  const auto hold = detector.current_hold();
  std::set<Python_skin*> skins;  // in one order for all detectors, so that none waits for the other
  for (const Object_id id : detector.ids_) {
    detector.refresh(id, hold);
    if (auto* const skin = detector.objects_[id]->skin(); skin != nullptr) skins.insert(skin);
  }
  for (auto* skin : skins) skins_.push_back(std::make_unique<Python_skin::Reading>(*skin));
  detector.reading_ = true;
}

void Python_detector::check_no_visitor() const {
  if (reading_) throw Bad_argument("a function that the detector calls (a visitor, a strategy, a promise) must not call it");
}

Python_object& Python_detector::at(Object_id object) const {
  if (object < objects_.size() && objects_[object]) return *objects_[object];
  if (object < objects_.size()) throw Bad_argument("object " + std::to_string(object) + " has been removed");
  throw Bad_argument("there is no object " + std::to_string(object));
}

std::string Python_detector::title_of(Object_id object) const {
  const auto& name = at(object).name();
  const auto id = "object " + std::to_string(object);
  return name.empty() ? id : id + " (" + name + ")";
}

void Python_detector::refresh(Object_id object, std::uint64_t hold) {
  try {
    objects_[object]->refresh(hold);
  } catch (const Bad_mesh& error) {
    throw Bad_mesh(title_of(object) + ": " + error.what());
  }
}

std::string Python_detector::text() {
  return look([&](auto&) {
    return "<lodestone.Detector mode='" + std::string(name_of(settings_.options.mode)) + "', " + std::to_string(ids_.size()) +
           " objects>";
  });
}

template <class Change>
void Python_detector::change_object(Object_id object, const Change& change) {
  auto& changed = at(object);
  try {
    change(changed);
  } catch (const Bad_argument& error) {
    throw Bad_argument(title_of(object) + ": " + error.what());
  } catch (const Bad_mesh& error) {
    throw Bad_mesh(title_of(object) + ": " + error.what());
  }
  ++poses_;
}

Object_id Python_detector::add(const py::object& mesh, const py::object& faces, const std::string& name,
                               std::size_t particles, std::uint32_t groups, std::uint32_t meets,
                               const py::object& file_vertex, const py::object& scattered_side) {
  Object_options options{.particles = particles, .groups = groups, .meets = meets, .name = name};
  if (!scattered_side.is_none()) {
    const auto side = vector_of(scattered_side, "scattered_side");
    options.scattered_side = Eigen::Vector3d(side.data());
    check(Senin_options{.side = options.scattered_side});
  }
  if (!file_vertex.is_none()) options.file_vertex = indices_of(file_vertex, "file_vertex");
  std::unique_ptr<Python_object> object;
  if (py::isinstance<Python_animation>(mesh) && faces.is_none()) {
    auto animation = mesh.cast<std::shared_ptr<Python_animation>>();
    if (name.empty()) options.name = animation->name;
    const Without_gil without_gil;
    object = std::make_unique<Python_object>(options.name, std::move(animation),
                                             settings_.options.mode == Mode::certified);
  } else if (py::isinstance<Python_animation>(mesh)) {
    throw Bad_argument("an Animation has faces of its own: give `mesh` to read_animation, not faces to this call");
  } else if (py::isinstance<Python_skin>(mesh)) {
    if (faces.is_none()) throw Bad_argument("a skin needs faces");
    object = naming_mesh(name, [&] {
      return std::make_unique<Python_object>(name, mesh.cast<std::shared_ptr<Python_skin>>(), faces);
    });
  } else {
    const auto given = given_mesh(mesh, faces, "a mesh");
    object = naming_mesh(name, [&] { return std::make_unique<Python_object>(name, given); });
  }
  return change([&](auto& detector) {
    const Object_id id = object->add_to(detector, options);
    ++poses_;
    objects_.push_back(std::move(object));
    ids_.push_back(id);
    if (options.particles > 0 && (fewest_particles_ == 0 || options.particles < fewest_particles_))
      fewest_particles_ = options.particles;
    return id;
  });
}

Particle_setting Python_detector::particle_setting() {
  return look([&](auto&) {
    const bool is_own = settings_.strategy.function != nullptr;
    return Particle_setting{.strategy = is_own ? std::string_view() : std::string_view(settings_.strategy.name),
                            .lbg = settings_.strategy_settings.lbg,
                            .fewest_particles = fewest_particles_};
  });
}

void Python_detector::set_vertices(Object_id object, const py::object& vertices) {
  const auto title = look([&](auto&) { return title_of(object); });
  auto given = naming_mesh(title, [&] { return std::make_unique<Live_vertices>(vertices); });
  change([&](auto& detector) {
    const auto exchange = [&] { change_object(object, [&](auto& target) { target.exchange(given); }); };
    exchange();
    try {
      detector.update(object);
    } catch (...) {
      exchange();
      throw;
    }
  });
  // With the GIL again: the former array goes.
}

void Python_detector::set_frame(Object_id object, py::ssize_t frame) {
  change([&](auto& detector) {
    change_object(object, [&](auto& target) { target.set_frame(frame); });
    detector.update(object);
  });
}

void Python_detector::update(std::optional<Object_id> object) {
  const Without_gil without_gil;
  const std::lock_guard lock(mutex_);
  check_no_visitor();
  for (Object_id id = 0; id < objects_.size(); ++id)
    if (objects_[id] && (!object || *object == id)) objects_[id]->read_anew();
  const Reading reading(*this);
  ++poses_;
  if (object)
    detector_.update(*object);
  else
    detector_.update();
}

void Python_detector::place(Object_id object, const py::object& matrix) {
  const Eigen::Matrix4d m = matrix_of(matrix, "matrix");
  change([&](auto& detector) {
    detector.place(object, Eigen::Isometry3d(m));
    change_object(object, [&](auto& target) { target.place(Eigen::Isometry3d(m)); });
  });
}

void Python_detector::rebuild(Object_id object, const py::object& vertices, const py::object& faces,
                              const py::object& changed, const py::object& file_vertex) {
  const auto title = look([&](auto&) { return title_of(object); });
  auto given = naming_mesh(title, [&] { return std::make_unique<Live_vertices>(vertices); });
  auto corners = naming_mesh(title, [&] { return surface_of(faces); });
  std::vector<std::uint32_t> changed_faces, doubled;
  if (!changed.is_none()) changed_faces = naming_mesh(title, [&] { return indices_of(changed, "changed"); });
  if (!file_vertex.is_none()) doubled = naming_mesh(title, [&] { return indices_of(file_vertex, "file_vertex"); });
  if (!changed.is_none() && !file_vertex.is_none()) throw Bad_argument("give changed or file_vertex, not both");
  change([&](auto& detector) {
    change_object(object, [&](auto& target) {
      if (!changed.is_none()) target.check_changed(corners, changed_faces);
      target.exchange(given, corners);
    });
    try {
      if (changed.is_none())
        detector.rebuild(object, doubled);
      else
        detector.rebuild(object, Changed_faces{changed_faces});
    } catch (...) {
      at(object).exchange(given, corners);
      throw;
    }
  });
}

Python_frame Python_detector::detect() {
  return found([](auto& detector) { return detector.detect(); });
}

Python_frame Python_detector::detect(Object_id a, Object_id b) {
  return found([&](auto& detector) { return detector.detect(a, b); });
}

template <class Detect>
Python_frame Python_detector::found(const Detect& detect) {
  const auto& options = settings_.options;
  Python_frame result{.with_points = options.contact_points, .with_normals = options.contact_normals};
  ask([&](auto& detector) {
    auto frame = std::make_shared<Frame>(detect(detector));
    last_frame_ = frame->number;
    result.frame = std::move(frame);
    result.poses = poses();
  });
  return result;
}

std::uint64_t Python_detector::poses() const {
  std::uint64_t sum = poses_;
  for (const Object_id id : ids_)
    if (objects_[id]->skin() != nullptr) sum += objects_[id]->skin()->pose_number();
  return sum;
}

void Python_detector::check_is_shown(const Python_frame& frame) {
  look([&](auto&) {
    const auto number = frame.frame->number;
    const auto before = "frame " + std::to_string(number) + " was found before ";
    if (number != last_frame_)
      throw Bad_argument(before + "frame " + std::to_string(last_frame_) +
                         ": add each frame before the next is asked for");
    if (frame.poses != poses())
      throw Bad_argument(before + "objects were moved, added, removed or rebuilt: add each frame before that");
  });
}

py::array Python_detector::positions(Object_id object) {
  const auto coordinates = change([&](auto&) {
    at(object);
    refresh(object, current_hold());
    return at(object).positions();
  });
  return positions_array(coordinates);
}

std::vector<Python_detector::Shown_object> Python_detector::shown() {
  return change([&](auto&) {
    std::vector<Shown_object> all;
    for (Object_id id = 0; id < objects_.size(); ++id) {
      const auto& object = objects_[id];
      if (!object) {
        all.emplace_back();
        continue;
      }
      refresh(id, current_hold());
      const auto corners = object->mesh().corners();
      all.push_back({object->name(), {corners.begin(), corners.end()}, object->positions()});
    }
    return all;
  });
}

void Python_detector::remove(Object_id object) {
  std::unique_ptr<Python_object> removed;
  change([&](auto& detector) {
    detector.remove(object);
    ++poses_;
    removed = std::move(objects_[object]);
    std::erase(ids_, object);
  });
  // With the GIL again: what it keeps goes.
}

void Python_detector::hold_positions() {
  change([&](auto& detector) {
    current_hold();
    held_.push_back(detector.hold_positions());
    hold_.begin();
  });
}

std::uint64_t Python_detector::current_hold() {
  for (std::size_t ended = released_.exchange(0); ended > 0; --ended) {
    held_.pop_back();
    hold_.end();
  }
  return hold_.number();
}

}  // namespace lodestone::python
