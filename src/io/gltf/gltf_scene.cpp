// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/gltf/gltf_scene.h"

#include <fmt/format.h>

#include <tiny_gltf.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <unordered_set>

#include "io/files/small_text.h"
#include "io/files/unique_names.h"
#include "io/formats/mesh_guard.h"
#include "io/gltf/gltf_guard.h"
#include "io/gltf/gltf_numbers.h"
#include "io/gltf/gltf_points.h"
#include "io/gltf/gltf_size.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {
namespace {

// ---- tinygltf ----

/// tinygltf requests files by the names that the guard gave them: the indices of the buffers.
bool buffer_is_there(const std::string&, void*) { return true; }
std::string buffer_name(const std::string& name, void*) { return name; }
bool take_buffer(std::vector<unsigned char>* out, std::string*, const std::string& name, void* user) {
  auto& buffers = *static_cast<std::vector<Bytes>*>(user);
  std::size_t number = buffers.size();
  std::from_chars(name.data(), name.data() + name.size(), number);
  if (number >= buffers.size()) return false;
  *out = std::move(buffers[number]);
  return true;
}
bool write_nothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }
bool load_no_image(tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int,
                   void*) {
  return true;
}

tinygltf::Model read_model(Guarded_gltf& guarded, const std::string& name) {
  tinygltf::TinyGLTF reader;
  reader.SetImageLoader(load_no_image, nullptr);
  reader.SetFsCallbacks({buffer_is_there, buffer_name, take_buffer, write_nothing, &guarded.buffers});
  tinygltf::Model model;
  std::string error, warning;
  const auto& json = guarded.plain;
  if (!reader.LoadASCIIFromString(&model, &error, &warning, json.data(), static_cast<unsigned>(json.size()), "")) {
    std::ranges::replace(error, '\n', ' ');
    throw Bad_mesh(fmt::format("{}: tinygltf refuses the file: {}", name, error));
  }
  return model;
}

// ---- Meshes ----

/// Reads the primitives of one mesh into one shape.
class Shape_reader {
 public:
  Shape_reader(const tinygltf::Model& model, std::size_t mesh, const std::string& name)
      : model_(model), mesh_(model.meshes[mesh]), number_(mesh), name_(name) {}

  Gltf_shape read();

 private:
  void read_primitive(const tinygltf::Primitive& primitive);
  void read_joints(const tinygltf::Primitive& primitive, std::size_t first, std::size_t count);
  std::vector<std::uint32_t> corners_of(const tinygltf::Primitive& primitive, std::size_t count) const;
  void add_faces(int mode, const std::vector<std::uint32_t>& corners, std::uint32_t first);
  void weld();
  void count_influences();

  const tinygltf::Model& model_;
  const tinygltf::Mesh& mesh_;
  std::size_t number_;  ///< of the mesh
  const std::string& name_;
  std::string place_;  ///< of the primitive that is read
  Gltf_shape shape_ = {};
};

void append_numbers(Coordinate_list& to, const std::vector<double>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

void Shape_reader::count_influences() {
  for (const auto& primitive : mesh_.primitives) {
    std::size_t sets = 0;
    while (primitive.attributes.contains(fmt::format("JOINTS_{}", sets))) ++sets;
    shape_.influences = std::max(shape_.influences, 4 * sets);
  }
}

std::vector<std::uint32_t> Shape_reader::corners_of(const tinygltf::Primitive& primitive, std::size_t count) const {
  if (primitive.indices < 0) {
    std::vector<std::uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0U);
    return all;
  }
  auto corners = gltf_whole_numbers(model_, primitive.indices, name_);
  const auto bad = std::ranges::find_if(corners, [&](std::uint32_t corner) { return corner >= count; });
  if (bad != corners.end())
    throw Bad_mesh(fmt::format("{}: index {} (counted from 0) refers to vertex {} of {}", place_, bad - corners.begin(),
                               *bad, count));
  return corners;
}

/// Strips and fans become triangles; points and lines give none.
void Shape_reader::add_faces(int mode, const std::vector<std::uint32_t>& corners, std::uint32_t first) {
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    shape_.faces.push_back({first + corners[a], first + corners[b], first + corners[c]});
  };
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    if (corners.size() % 3 != 0)
      throw Bad_mesh(fmt::format("{}: {} corners do not make whole triangles", place_, corners.size()));
    for (std::size_t i = 0; i < corners.size(); i += 3) add(i, i + 1, i + 2);
  } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) add(i, i + 1 + i % 2, i + 2 - i % 2);
  } else if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) add(0, i, i + 1);
  }
}

/// Normalises the weights to a sum of 1, since rounded weights do not add up to it. A vertex without weights follows
/// its first joint.
void Shape_reader::read_joints(const tinygltf::Primitive& primitive, std::size_t first, std::size_t count) {
  const auto width = shape_.influences;
  shape_.joints.resize((first + count) * width);
  shape_.joint_weights.resize((first + count) * width);
  for (std::size_t set = 0; primitive.attributes.contains(fmt::format("JOINTS_{}", set)); ++set) {
    const auto joints = gltf_whole_numbers(model_, primitive.attributes.at(fmt::format("JOINTS_{}", set)), name_);
    const auto weights = gltf_numbers(model_, primitive.attributes.at(fmt::format("WEIGHTS_{}", set)), name_);
    for (std::size_t vertex = 0; vertex < count; ++vertex)
      for (std::size_t k = 0; k < 4; ++k) {
        const auto at = (first + vertex) * width + 4 * set + k;
        shape_.joints[at] = joints[4 * vertex + k];
        shape_.joint_weights[at] = weights[4 * vertex + k];
      }
  }
  for (std::size_t vertex = first; vertex < first + count && width > 0; ++vertex) {
    const auto weights = std::span(shape_.joint_weights).subspan(vertex * width, width);
    if (std::ranges::any_of(weights, [](double weight) { return weight < 0; }))
      throw Bad_mesh(fmt::format("{}: vertex {} (counted from 0) has a negative joint weight", place_, vertex - first));
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (sum == 0) weights[0] = 1;
    for (double& weight : weights) weight /= sum == 0 ? 1 : sum;
    for (std::size_t k = 0; k < width; ++k)
      if (weights[k] == 0) shape_.joints[vertex * width + k] = 0;
  }
}

void Shape_reader::read_primitive(const tinygltf::Primitive& primitive) {
  const auto first = shape_.vertices();
  const auto positions = gltf_numbers(model_, primitive.attributes.at("POSITION"), name_);
  const auto count = positions.size() / 3;
  append_numbers(shape_.positions, positions);
  shape_.targets.resize(primitive.targets.size());
  for (std::size_t target = 0; target < primitive.targets.size(); ++target) {
    const auto position = primitive.targets[target].find("POSITION");
    if (position == primitive.targets[target].end()) continue;
    shape_.targets[target].resize(3 * first);
    append_numbers(shape_.targets[target], gltf_numbers(model_, position->second, name_));
  }
  read_joints(primitive, first, count);
  add_faces(primitive.mode, corners_of(primitive, count), static_cast<std::uint32_t>(first));
}

/// Vertices are equal if everything that determines their positions over time is equal.
struct Same_vertex {
  const Gltf_shape* shape;

  template <class Visit>
  void visit_lists(const Visit& visit) const {
    visit(shape->positions, std::size_t{3});
    for (const auto& target : shape->targets)
      if (!target.empty()) visit(target, std::size_t{3});
    visit(shape->joints, shape->influences);
    visit(shape->joint_weights, shape->influences);
  }
  std::size_t operator()(std::uint32_t vertex) const {
    std::size_t hash = 0;
    visit_lists([&](const auto& list, std::size_t width) {
      for (std::size_t k = 0; k < width; ++k)
        hash = (hash ^ std::hash<double>()(list[vertex * width + k] + 0.0)) * 0x9E3779B97F4A7C15U;
    });
    return hash ^ (hash >> 32U);
  }
  bool operator()(std::uint32_t a, std::uint32_t b) const {
    bool same = true;
    visit_lists([&](const auto& list, std::size_t width) {
      for (std::size_t k = 0; k < width && same; ++k) same = list[a * width + k] == list[b * width + k];
    });
    return same;
  }
};

void Shape_reader::weld() {
  const auto count = static_cast<std::uint32_t>(shape_.vertices());
  const Same_vertex same{&shape_};
  std::unordered_set<std::uint32_t, Same_vertex, Same_vertex> seen(count, same, same);
  std::vector<std::uint32_t> first_of(count);
  for (std::uint32_t vertex = 0; vertex < count; ++vertex) first_of[vertex] = *seen.insert(vertex).first;
  shape_.joined = joined_of(first_of, shape_.faces);
  for (auto& face : shape_.faces)
    for (auto& corner : face) corner = first_of[corner];
}

Gltf_shape Shape_reader::read() {
  count_influences();
  shape_.weights = mesh_.weights;
  for (std::size_t i = 0; i < mesh_.primitives.size(); ++i) {
    place_ = fmt::format("{}: /meshes/{}/primitives/{}", name_, number_, i);
    read_primitive(mesh_.primitives[i]);
  }
  for (auto& target : shape_.targets)
    if (!target.empty()) target.resize(shape_.positions.size());
  shape_.weights.resize(shape_.targets.size());
  weld();
  return std::move(shape_);
}

// ---- Nodes ----

/// @throws Bad_mesh  the matrix is not affine; exporters may have rounded
Eigen::Affine3d affine(const double* columns, const std::string& place) {
  const Eigen::Map<const Eigen::Matrix4d> matrix(columns);
  constexpr double rounding = 1e-4;
  if (!((matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= rounding))
    throw Bad_mesh(place + ": the last row of the matrix is not 0, 0, 0, 1");
  return Eigen::Affine3d(matrix);
}

Eigen::Vector3d vector_or(const std::vector<double>& numbers, const Eigen::Vector3d& otherwise) {
  return numbers.empty() ? otherwise : Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
}

Gltf_place place_of(const tinygltf::Node& node, const std::string& place) {
  Gltf_place result;
  if (!node.matrix.empty()) result.matrix = affine(node.matrix.data(), place);
  result.translation = vector_or(node.translation, {0, 0, 0});
  result.scale = vector_or(node.scale, {1, 1, 1});
  if (node.rotation.empty()) return result;
  result.rotation = Eigen::Quaterniond(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
  const double length = result.rotation.norm();
  if (!(length > 0) || !std::isfinite(length)) throw Bad_mesh(place + ": the rotation has no direction");
  result.rotation.normalize();
  return result;
}

void read_nodes(const tinygltf::Model& model, Gltf_scene& scene) {
  scene.nodes.resize(model.nodes.size());
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    scene.nodes[i].place = place_of(model.nodes[i], fmt::format("{}: /nodes/{}", scene.name, i));
    scene.nodes[i].weights = model.nodes[i].weights;
    for (const int child : model.nodes[i].children) scene.nodes[static_cast<std::size_t>(child)].parent = i;
  }
  for (std::size_t i = 0; i < scene.nodes.size(); ++i)
    if (scene.nodes[i].parent == no_index) scene.order.push_back(i);
  for (std::size_t i = 0; i < scene.order.size(); ++i)
    for (const int child : model.nodes[scene.order[i]].children) scene.order.push_back(static_cast<std::size_t>(child));
}

void read_skins(const tinygltf::Model& model, Gltf_scene& scene) {
  for (std::size_t i = 0; i < model.skins.size(); ++i) {
    const auto& skin = model.skins[i];
    Gltf_skin result{.joints = {skin.joints.begin(), skin.joints.end()}};
    result.from_mesh.assign(result.joints.size(), Eigen::Affine3d::Identity());
    if (skin.inverseBindMatrices >= 0) {
      const auto numbers = gltf_numbers(model, skin.inverseBindMatrices, scene.name);
      for (std::size_t joint = 0; joint < result.joints.size(); ++joint)
        result.from_mesh[joint] =
            affine(numbers.data() + 16 * joint, fmt::format("{}: /skins/{}: joint {}", scene.name, i, joint));
    }
    scene.skins.push_back(std::move(result));
  }
}

/// The nodes of the default scene, in file order; all nodes if the file has no scenes.
std::vector<std::size_t> shown_nodes(const tinygltf::Model& model, const Gltf_scene& scene) {
  if (model.scenes.empty()) return scene.order;
  const auto number = model.defaultScene < 0 ? 0U : static_cast<std::size_t>(model.defaultScene);
  std::vector<bool> shown(scene.nodes.size());
  for (const int root : model.scenes[number].nodes) shown[static_cast<std::size_t>(root)] = true;
  std::vector<std::size_t> nodes;
  for (const auto node : scene.order) {
    const auto parent = scene.nodes[node].parent;
    shown[node] = shown[node] || (parent != no_index && shown[parent]);
    if (shown[node]) nodes.push_back(node);
  }
  return nodes;
}

void check_joints(const Gltf_part& part, const Gltf_scene& scene) {
  const auto joints = scene.skins[part.skin].joints.size();
  const auto largest = std::ranges::max_element(part.shape->joints);
  if (largest != part.shape->joints.end() && *largest >= joints)
    throw Bad_mesh(fmt::format("{}: /nodes/{}: a vertex follows joint {} (counted from 0), but /skins/{} has {}",
                               scene.name, part.node, *largest, part.skin, joints));
}

/// @param node  shows a mesh
std::string part_name(const tinygltf::Model& model, std::size_t node) {
  const auto& shown = model.nodes[node];
  if (!shown.name.empty()) return printable(shown.name);
  const auto& mesh = model.meshes[static_cast<std::size_t>(shown.mesh)];
  return mesh.name.empty() ? fmt::format("node_{}", node) : printable(mesh.name);
}

void read_parts(const tinygltf::Model& model, const Mesh_file_options& options, Gltf_scene& scene) {
  std::vector<std::shared_ptr<const Gltf_shape>> shapes(model.meshes.size());
  std::size_t faces = 0;
  Unique_names names;
  for (const auto node : shown_nodes(model, scene)) {
    if (model.nodes[node].mesh < 0) continue;
    const auto mesh = static_cast<std::size_t>(model.nodes[node].mesh);
    auto& shape = shapes[mesh];
    if (!shape) shape = std::make_shared<Gltf_shape>(Shape_reader(model, mesh, scene.name).read());
    const auto skin = model.nodes[node].skin;
    Gltf_part part{shape, node, skin < 0 ? no_index : static_cast<std::size_t>(skin), scene.vertices};
    part.name = names.take(part_name(model, node));
    if (part.skin != no_index) check_joints(part, scene);
    scene.vertices += shape->vertices();
    faces += shape->faces.size();
    // Many nodes can show one mesh, so a short file can describe more faces than fit into memory.
    if (faces > options.max_faces || scene.vertices > 3 * options.max_faces)
      throw Bad_mesh(fmt::format("{}: {}", scene.name, too_many_faces(faces, options.max_faces)));
    scene.parts.push_back(std::move(part));
  }
  if (faces == 0) throw Bad_mesh(fmt::format("{}: the file holds no face", scene.name));
}

// ---- Animations ----

Gltf_path path_of(const std::string& name) {
  if (name == "translation") return Gltf_path::translation;
  if (name == "rotation") return Gltf_path::rotation;
  return name == "scale" ? Gltf_path::scale : Gltf_path::weights;
}

Gltf_interpolation interpolation_of(const std::string& name) {
  if (name == "STEP") return Gltf_interpolation::step;
  return name == "CUBICSPLINE" ? Gltf_interpolation::cubic : Gltf_interpolation::linear;
}

void check_times(const std::vector<double>& times, const std::string& place) {
  if (times.front() < 0) throw Bad_mesh(place + ": a time is negative");
  const auto bad = std::ranges::adjacent_find(times, std::greater_equal<>());
  if (bad != times.end())
    throw Bad_mesh(
        fmt::format("{}: time {} (counted from 0) is not after the one before", place, bad + 1 - times.begin()));
}

void read_animations(const tinygltf::Model& model, Gltf_scene& scene) {
  for (std::size_t a = 0; a < model.animations.size(); ++a) {
    Gltf_animation animation{.name = model.animations[a].name};
    for (const auto& channel : model.animations[a].channels) {
      const auto& sampler = model.animations[a].samplers[static_cast<std::size_t>(channel.sampler)];
      Gltf_curve curve{.node = static_cast<std::size_t>(channel.target_node),
                       .path = path_of(channel.target_path),
                       .interpolation = interpolation_of(sampler.interpolation)};
      curve.times = gltf_numbers(model, sampler.input, scene.name);
      curve.values = gltf_numbers(model, sampler.output, scene.name);
      check_times(curve.times, fmt::format("{}: /accessors/{}", scene.name, sampler.input));
      const std::size_t per_time = curve.interpolation == Gltf_interpolation::cubic ? 3 : 1;
      curve.width = curve.values.size() / curve.times.size() / per_time;
      animation.seconds = std::max(animation.seconds, curve.times.back());
      animation.curves.push_back(std::move(curve));
    }
    scene.animations.push_back(std::move(animation));
  }
}

}  // namespace

std::shared_ptr<const Gltf_scene> read_gltf_scene(const std::filesystem::path& file, const Mesh_file_options& options) {
  try {
    auto guarded = guard_gltf(file, options.max_bytes);
    const auto scene = std::make_shared<Gltf_scene>(Gltf_scene{.name = file.string()});
    const auto model = read_model(guarded, scene->name);
    check_gltf_size(model, scene->name, options);
    read_nodes(model, *scene);
    read_skins(model, *scene);
    read_parts(model, options, *scene);
    read_animations(model, *scene);
    scene->files = std::move(guarded.files);
    scene->not_read = std::move(guarded.not_read);
    scene->ignored_extensions = std::move(guarded.ignored_extensions);
    return scene;
  } catch (const Bad_scene& error) {
    throw Bad_mesh(error.what());
  }
}

bool is_gltf(const std::filesystem::path& file) {
  const auto extension = lower_case(file.extension().string());
  return extension == ".gltf" || extension == ".glb";
}

namespace {

/// Whether a node turns inside out what its parent does not, at rest.
bool is_turned(const Gltf_place& place) {
  return (place.matrix ? place.matrix->linear().determinant() : place.scale.prod()) < 0;
}

/// Which parts are turned inside out, at rest: glTF then gives the corners of faces the other way round. All nodes, and
/// all skins, are looked at once, since parts can share them. O(nodes + joints).
class Mirrored_parts {
 public:
  explicit Mirrored_parts(const Gltf_scene& scene) : nodes_(scene.nodes.size()) {
    for (const std::size_t node : scene.order) {
      const std::size_t parent = scene.nodes[node].parent;
      nodes_[node] = is_turned(scene.nodes[node].place) != (parent != no_index && nodes_[parent]);
    }
    for (const Gltf_skin& skin : scene.skins) skins_.push_back(is_turned_by_joints(skin));
  }
  bool operator()(const Gltf_part& part) const { return part.skin == no_index ? nodes_[part.node] : skins_[part.skin]; }

 private:
  /// A skin does not care where its node is; it is turned where most of its joints turn it.
  bool is_turned_by_joints(const Gltf_skin& skin) const {
    std::size_t mirrored = 0;
    for (std::size_t joint = 0; joint < skin.joints.size(); ++joint)
      mirrored += nodes_[skin.joints[joint]] != (skin.from_mesh[joint].linear().determinant() < 0) ? 1 : 0;
    return 2 * mirrored > skin.joints.size();
  }

  std::vector<bool> nodes_, skins_;
};

}  // namespace

Joined_vertices joined_vertices(const Gltf_scene& scene) {
  if (std::ranges::all_of(scene.parts, [](const auto& part) { return part.shape->joined.empty(); })) return {};
  Joined_vertices joined;
  for (const auto& part : scene.parts)
    for (std::size_t vertex = 0; vertex < part.shape->vertices(); ++vertex) {
      const auto& own = part.shape->joined;
      joined.push_back(static_cast<std::uint32_t>(part.first_vertex + (own.empty() ? vertex : own[vertex])));
    }
  return joined;
}

Polygon_soup soup_of(std::shared_ptr<const Gltf_scene> scene) {
  Polygon_soup soup;
  soup.joined = joined_vertices(*scene);
  soup.not_read = scene->not_read;
  soup.ignored_extensions = scene->ignored_extensions;
  soup.files = scene->files;
  soup.points.resize(scene->vertices);
  try {
    pose_all(Gltf_points(scene, all_vertices(*scene)), scene->name, soup.points);
  } catch (const Bad_motion& error) {
    throw Bad_mesh(error.what());
  }
  const Mirrored_parts is_mirrored(*scene);
  for (const auto& part : scene->parts) {
    begin_part(part.name, static_cast<std::uint32_t>(soup.faces.size()), soup.parts);
    const bool mirrored = is_mirrored(part);
    for (auto [a, b, c] : part.shape->faces) {
      if (mirrored) std::swap(b, c);
      soup.faces.push_back({part.first_vertex + a, part.first_vertex + b, part.first_vertex + c});
    }
  }
  return soup;
}

}  // namespace lodestone
