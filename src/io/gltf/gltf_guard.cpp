// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/gltf/gltf_guard.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "io/files/json_reader.h"
#include "io/gltf/gltf_unread.h"

namespace lodestone {
namespace {

using detail::Json;
using detail::Json_value;

constexpr std::size_t most_elements = 10'000'000;
// tinygltf stores some offsets and counts as signed 32-bit integers.
constexpr std::size_t most_bytes = std::numeric_limits<std::int32_t>::max();

struct Component {
  std::size_t code;
  std::size_t bytes;
};
constexpr std::array<Component, 6> components{{{5120, 1}, {5121, 1}, {5122, 2}, {5123, 2}, {5125, 4}, {5126, 4}}};
constexpr std::size_t as_float = 5126;

struct Element {
  std::string_view name;
  std::size_t numbers;
};
// MAT2 and MAT3 are missing, and MAT4 is read as floats only: no attribute that is read uses the others, and matrices
// of bytes and shorts have padding.
constexpr std::array<Element, 5> elements{{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}}};

struct Accessor {
  std::string type;
  std::size_t component = 0;
  std::size_t count = 0;
  bool normalized = false;
  bool readable = true;  ///< false for the matrix types that are not read
};

struct View {
  std::size_t length = 0, stride = 0;
};

/// Checks the sections in the order in which they refer to each other, and copies what is used.
class Guard {
 public:
  Guard(const Gltf_document& document, const std::vector<Bytes>& buffers)
      : root_(document.json, document.name), buffers_(buffers) {}

  std::string plain() {
    plain_ = {{"asset", {{"version", "2.0"}}}};
    for (std::size_t i = 0; i < buffers_.size(); ++i)
      plain_["buffers"].push_back({{"byteLength", buffers_[i].size()}, {"uri", std::to_string(i)}});
    copy("bufferViews", [&](const Json_value& view) { return copy_view(view); });
    copy_accessors();
    copy("meshes", [&](const Json_value& mesh) { return copy_mesh(mesh); });
    nodes_ = root_.list("nodes", most_elements).size();
    copy("skins", [&](const Json_value& skin) { return copy_skin(skin); });
    copy("nodes", [&](const Json_value& node) { return copy_node(node); });
    check_tree();
    copy("animations", [&](const Json_value& animation) { return copy_animation(animation); });
    copy_scenes();
    return plain_.dump();
  }

 private:
  template <class Copy>
  void copy(const char* section, const Copy& copy_one) {
    for (const auto& element : root_.list(section, most_elements)) {
      element.expect_object();
      plain_[section].push_back(copy_one(element));
    }
  }

  /// `value` as an index into a list of `count` elements.
  static std::size_t index(const Json_value& value, std::string_view things, std::size_t count) {
    if (count == 0) value.fail(fmt::format("refers to one of the {}, but there are none", things));
    return value.count(0, count - 1);
  }
  std::size_t accessor_index(const Json_value& value) const { return index(value, "accessors", accessors_.size()); }

  Json copy_view(const Json_value& view);
  void copy_accessors();
  Json copy_accessor(const Json_value& accessor);
  Json copy_sparse(const Json_value& sparse, std::size_t count, std::size_t element_bytes) const;
  void expect_room(const Json_value& place, std::size_t view, std::size_t offset, std::size_t count, std::size_t bytes,
                   std::size_t stride) const;
  const Accessor& expect(const Json_value& place, std::string_view type, bool whole) const;
  Json copy_mesh(const Json_value& mesh);
  Json copy_primitive(const Json_value& primitive, std::size_t& targets) const;
  void expect_uncompressed(const Json_value& primitive, std::size_t positions) const;
  Json copy_attributes(const Json_value& attributes, std::size_t& vertices) const;
  Json copy_skin(const Json_value& skin) const;
  Json copy_node(const Json_value& node);
  void copy_place(const Json_value& node, Json& plain) const;
  void check_tree() const;
  Json copy_animation(const Json_value& animation) const;
  Json copy_sampler(const Json_value& sampler) const;
  void check_channel(const Json_value& target, const Json& sampler) const;
  std::size_t numbers_per_key(const Json_value& target, const std::string& path) const;
  std::size_t targets_of(std::size_t node) const;
  void copy_scenes();

  Json_value root_;
  const std::vector<Bytes>& buffers_;
  Json plain_;
  std::vector<View> views_;
  std::vector<Accessor> accessors_;
  std::size_t most_stored_ = 0;            ///< length of the longest accessor whose elements are stored in the file
  std::vector<std::size_t> mesh_targets_;  ///< morph targets per mesh
  std::vector<bool> mesh_has_joints_;
  std::size_t nodes_ = 0;
  std::vector<std::vector<std::size_t>> children_ = {};
};

void check_asset(const Json_value& root) {
  const auto asset = root.at("asset");
  const auto version = asset.at("version").text();
  if (!version.starts_with("2."))
    asset.at("version").fail(fmt::format("expected 2.0, found {}", detail::as_json(version)));
  if (const auto least = asset.find("minVersion"); least && least->text() != "2.0")
    least->fail(fmt::format("expected 2.0, found {}", detail::as_json(least->text())));
  // An extension that affects positions must be supported; one that affects only appearance may be ignored.
  for (const auto& extension : root.list("extensionsRequired", most_elements)) {
    const auto name = extension.text();
    const bool harmless = name == "KHR_mesh_quantization" || name.starts_with("KHR_materials_") ||
                          name.starts_with("KHR_texture_") || name.starts_with("EXT_texture_") ||
                          name.starts_with("MSFT_texture_") || name.starts_with("EXT_lights_") ||
                          name == "KHR_lights_punctual" || name == "KHR_xmp_json_ld";
    if (!harmless) extension.fail(fmt::format("the extension {} is not supported", detail::as_json(name)));
  }
}

// ---- Buffers ----

Json Guard::copy_view(const Json_value& view) {
  const auto buffer = index(view.at("buffer"), "buffers", buffers_.size());
  const auto size = buffers_[buffer].size();
  const auto offset = view.count("byteOffset", 0, size, 0);
  const auto length = view.at("byteLength").count(1, std::max<std::size_t>(size, 1));
  if (length > size - offset)
    view.fail(fmt::format("{} bytes from byte {} on do not fit into the buffer of {}", length, offset, size));
  const auto stride = view.count("byteStride", 4, 252, 0);
  if (stride % 4 != 0) view.at("byteStride").fail(fmt::format("{} is not a multiple of 4", stride));
  views_.push_back({length, stride});
  Json plain{{"buffer", buffer}, {"byteOffset", offset}, {"byteLength", length}};
  if (stride > 0) plain["byteStride"] = stride;
  return plain;
}

/// @param stride  bytes from one element to the next
void Guard::expect_room(const Json_value& place, std::size_t view, std::size_t offset, std::size_t count,
                        std::size_t bytes, std::size_t stride) const {
  const auto length = views_[view].length;
  if (offset > length || bytes > length - offset || (count - 1) > (length - offset - bytes) / stride)
    place.fail(fmt::format("{} elements of {} bytes from byte {} on do not fit into the buffer view of {}", count,
                           bytes, offset, length));
}

void Guard::copy_accessors() {
  const auto all = root_.list("accessors", most_elements);
  for (const auto& accessor : all) {
    accessor.expect_object();
    plain_["accessors"].push_back(copy_accessor(accessor));
  }
  // An accessor of zeros is not stored, so the file's size does not limit it: the longest stored accessor does.
  for (std::size_t i = 0; i < all.size(); ++i)
    if (accessors_[i].count > most_stored_)
      all[i].fail(fmt::format("has {} elements, more than any stored accessor has", accessors_[i].count));
}

Json Guard::copy_accessor(const Json_value& value) {
  const auto type = value.at("type").text();
  const auto code = value.at("componentType").count(0, 100'000);
  const auto* const component = std::ranges::find(components, code, &Component::code);
  if (component == components.end()) value.at("componentType").fail(fmt::format("{} is not a component type", code));
  const auto* const element = std::ranges::find(elements, type, &Element::name);
  const bool readable = element != elements.end() && (type != "MAT4" || code == as_float);
  if (!readable && type != "MAT2" && type != "MAT3" && type != "MAT4")
    value.at("type").fail(fmt::format("{} is not an accessor type", detail::as_json(type)));
  Accessor accessor{.type = type, .component = code, .count = value.at("count").count(1, most_bytes)};
  accessor.readable = readable;
  if (const auto normalized = value.find("normalized")) accessor.normalized = normalized->boolean();

  Json plain{{"componentType", code}, {"type", type}, {"count", accessor.count}, {"normalized", accessor.normalized}};
  if (readable) {
    const auto bytes = component->bytes * element->numbers;
    if (const auto view = value.find("bufferView")) {
      const auto number = index(*view, "buffer views", views_.size());
      const auto offset = value.count("byteOffset", 0, most_bytes, 0);
      const auto stride = views_[number].stride > 0 ? views_[number].stride : bytes;
      if (stride < bytes)
        value.fail(fmt::format("elements of {} bytes are {} bytes apart in the buffer view", bytes, stride));
      expect_room(value, number, offset, accessor.count, bytes, stride);
      plain["bufferView"] = number;
      plain["byteOffset"] = offset;
      most_stored_ = std::max(most_stored_, accessor.count);
    }
    if (const auto sparse = value.find("sparse")) {
      plain["sparse"] = copy_sparse(*sparse, accessor.count, bytes);
      most_stored_ = std::max(most_stored_, plain["sparse"]["count"].get<std::size_t>());
    }
  } else {
    most_stored_ = std::max(most_stored_, std::size_t{1});
    accessor.count = plain["count"] = 1;
  }
  accessors_.push_back(std::move(accessor));
  return plain;
}

Json Guard::copy_sparse(const Json_value& sparse, std::size_t count, std::size_t element_bytes) const {
  const auto changed = sparse.at("count").count(1, count);
  const auto indices = sparse.at("indices"), values = sparse.at("values");
  const auto code = indices.at("componentType").count(0, 100'000);
  if (code != 5121 && code != 5123 && code != 5125)
    indices.at("componentType").fail(fmt::format("{} is not an index type, expected 5121, 5123 or 5125", code));
  const auto index_bytes = std::ranges::find(components, code, &Component::code)->bytes;
  const auto index_view = index(indices.at("bufferView"), "buffer views", views_.size());
  const auto index_offset = indices.count("byteOffset", 0, most_bytes, 0);
  expect_room(indices, index_view, index_offset, changed, index_bytes, index_bytes);
  const auto value_view = index(values.at("bufferView"), "buffer views", views_.size());
  const auto value_offset = values.count("byteOffset", 0, most_bytes, 0);
  expect_room(values, value_view, value_offset, changed, element_bytes, element_bytes);
  return {{"count", changed},
          {"indices", {{"bufferView", index_view}, {"byteOffset", index_offset}, {"componentType", code}}},
          {"values", {{"bufferView", value_view}, {"byteOffset", value_offset}}}};
}

/// The accessor that `place` names, which must have this type.
/// @param whole  true: unsigned integers; false: real numbers, which may be stored as normalized integers
const Accessor& Guard::expect(const Json_value& place, std::string_view type, bool whole) const {
  const auto& accessor = accessors_[accessor_index(place)];
  if (accessor.type != type || !accessor.readable)
    place.fail(fmt::format("expected an accessor of type {}, found {}", type, accessor.type));
  const bool is_whole = accessor.component == 5121 || accessor.component == 5123 || accessor.component == 5125;
  if (whole && (!is_whole || accessor.normalized)) place.fail("expected an accessor of unsigned integers");
  return accessor;
}

void copy_name(const Json_value& from, Json& plain) {
  if (const auto name = from.find("name"); name && name->is_string()) plain["name"] = name->any_text();
}

// ---- Meshes ----

Json Guard::copy_mesh(const Json_value& mesh) {
  Json plain{{"primitives", Json::array()}};
  constexpr std::size_t unknown = std::numeric_limits<std::size_t>::max();
  std::size_t targets = unknown;
  bool joints = true;
  for (const auto& primitive : mesh.at("primitives").elements(most_elements)) {
    primitive.at("attributes").expect_object();
    if (!primitive.at("attributes").has("POSITION")) continue;  // there is nothing to show
    std::size_t found = 0;
    plain["primitives"].push_back(copy_primitive(primitive, found));
    if (targets != unknown && targets != found)
      primitive.fail(fmt::format("has {} morph targets, those before have {}", found, targets));
    targets = found;
    joints &= plain["primitives"].back()["attributes"].contains("JOINTS_0");
  }
  const bool shows_something = targets != unknown;
  if (!shows_something) targets = 0;
  if (const auto weights = mesh.find("weights");
      weights && shows_something && !mesh.list("weights", most_elements).empty()) {
    plain["weights"] = Json::array();
    for (const auto& weight : weights->elements(most_elements)) plain["weights"].push_back(weight.number());
    if (plain["weights"].size() != targets)
      weights->fail(fmt::format("has {} weights for {} morph targets", plain["weights"].size(), targets));
  }
  mesh_targets_.push_back(targets);
  mesh_has_joints_.push_back(joints);
  copy_name(mesh, plain);
  return plain;
}

Json Guard::copy_primitive(const Json_value& primitive, std::size_t& targets) const {
  std::size_t vertices = 0;
  Json plain{{"attributes", copy_attributes(primitive.at("attributes"), vertices)},
             {"mode", primitive.count("mode", 0, 6, 4)}};
  expect_uncompressed(primitive, plain["attributes"]["POSITION"].get<std::size_t>());
  if (const auto indices = primitive.find("indices")) {
    expect(*indices, "SCALAR", true);
    // tinygltf refuses an accessor of indices that has no buffer view.
    const auto number = accessor_index(*indices);
    if (!plain_["accessors"][number].contains("bufferView")) indices->fail("expected indices with a buffer view");
    plain["indices"] = number;
  }
  for (const auto& target : primitive.list("targets", most_elements)) {
    target.expect_object();
    Json plain_target = Json::object();
    if (const auto position = target.find("POSITION")) {
      if (expect(*position, "VEC3", false).count != vertices)
        position->fail(fmt::format("the morph target has {} vertices, the mesh {}",
                                   accessors_[accessor_index(*position)].count, vertices));
      plain_target["POSITION"] = accessor_index(*position);
    }
    plain["targets"].push_back(std::move(plain_target));
    ++targets;
  }
  return plain;
}

/// A file that calls compression optional must store a copy without it. Where there is none, all positions would be 0.
void Guard::expect_uncompressed(const Json_value& primitive, std::size_t positions) const {
  const auto extensions = primitive.find("extensions");
  const auto& accessor = plain_["accessors"][positions];
  if (!extensions || !extensions->has("KHR_draco_mesh_compression")) return;
  if (!accessor.contains("bufferView") && !accessor.contains("sparse"))
    primitive.fail("is stored by KHR_draco_mesh_compression alone, which is not supported");
}

/// Copies POSITION, and the pairs JOINTS_n and WEIGHTS_n.
Json Guard::copy_attributes(const Json_value& attributes, std::size_t& vertices) const {
  const auto position = attributes.at("POSITION");
  vertices = expect(position, "VEC3", false).count;
  Json plain{{"POSITION", accessor_index(position)}};
  for (std::size_t set = 0;; ++set) {
    const auto joints_name = fmt::format("JOINTS_{}", set), weights_name = fmt::format("WEIGHTS_{}", set);
    const auto joints = attributes.find(joints_name), weights = attributes.find(weights_name);
    if (!joints && !weights) return plain;
    if (!joints || !weights)
      attributes.fail(fmt::format("{} and {} must be given together", joints_name, weights_name));
    if (expect(*joints, "VEC4", true).count != vertices || expect(*weights, "VEC4", false).count != vertices)
      attributes.fail(fmt::format("expected {} and {} for {} vertices", joints_name, weights_name, vertices));
    plain[joints_name] = accessor_index(*joints);
    plain[weights_name] = accessor_index(*weights);
  }
}

// ---- Nodes ----

Json Guard::copy_skin(const Json_value& skin) const {
  Json plain{{"joints", Json::array()}};
  for (const auto& joint : skin.at("joints").elements(most_elements))
    plain["joints"].push_back(index(joint, "nodes", nodes_));
  if (const auto matrices = skin.find("inverseBindMatrices")) {
    if (expect(*matrices, "MAT4", false).count < plain["joints"].size())
      matrices->fail(fmt::format("there are fewer matrices than the {} joints", plain["joints"].size()));
    plain["inverseBindMatrices"] = accessor_index(*matrices);
  }
  return plain;
}

Json Guard::copy_node(const Json_value& node) {
  Json plain = Json::object();
  children_.emplace_back();
  for (const auto& child : node.list("children", most_elements)) {
    children_.back().push_back(index(child, "nodes", nodes_));
    plain["children"].push_back(children_.back().back());
  }
  copy_place(node, plain);
  copy_name(node, plain);
  const auto mesh = node.find("mesh");
  if (mesh) plain["mesh"] = index(*mesh, "meshes", mesh_targets_.size());
  if (const auto skin = node.find("skin")) {
    plain["skin"] = index(*skin, "skins", plain_.contains("skins") ? plain_["skins"].size() : 0);
    if (mesh && !mesh_has_joints_[plain["mesh"].get<std::size_t>()])
      skin->fail("the mesh of the node has no JOINTS_0 and WEIGHTS_0");
  }
  if (const auto weights = node.find("weights"); weights && mesh && !node.list("weights", most_elements).empty()) {
    for (const auto& weight : weights->elements(most_elements)) plain["weights"].push_back(weight.number());
    const auto targets = mesh_targets_[plain["mesh"].get<std::size_t>()];
    if (plain["weights"].size() != targets)
      weights->fail(fmt::format("has {} weights for {} morph targets", plain["weights"].size(), targets));
  }
  return plain;
}

void Guard::copy_place(const Json_value& node, Json& plain) const {
  constexpr std::array<std::pair<const char*, std::size_t>, 4> fields{
      {{"matrix", 16}, {"translation", 3}, {"rotation", 4}, {"scale", 3}}};
  for (const auto& [key, length] : fields) {
    const auto value = node.find(key);
    if (!value) continue;
    if (plain.contains("matrix")) value->fail("cannot be combined with a matrix");
    plain[key] = Json::array();
    for (const auto& number : value->elements(length)) plain[key].push_back(number.number());
    if (plain[key].size() != length)
      value->fail(fmt::format("expected {} numbers, found {}", length, plain[key].size()));
  }
}

/// Checks that every node has at most one parent and is not its own ancestor.
void Guard::check_tree() const {
  std::vector<std::size_t> parent(nodes_, nodes_);
  const auto all = root_.list("nodes", most_elements);
  for (std::size_t node = 0; node < nodes_; ++node)
    for (const auto child : children_[node]) {
      if (parent[child] != nodes_)
        all[child].fail(fmt::format("is a child of node {} and of node {}", parent[child], node));
      parent[child] = node;
    }
  std::vector<std::size_t> reached;
  for (std::size_t node = 0; node < nodes_; ++node)
    if (parent[node] == nodes_) reached.push_back(node);
  for (std::size_t i = 0; i < reached.size(); ++i)
    reached.insert(reached.end(), children_[reached[i]].begin(), children_[reached[i]].end());
  if (reached.size() == nodes_) return;
  std::vector<bool> seen(nodes_);
  for (const auto node : reached) seen[node] = true;
  const auto first = static_cast<std::size_t>(std::ranges::find(seen, false) - seen.begin());
  all[first].fail("is its own ancestor: the nodes form a cycle");
}

void Guard::copy_scenes() {
  copy("scenes", [&](const Json_value& scene) {
    Json plain{{"nodes", Json::array()}};
    std::set<std::size_t> taken;
    for (const auto& node : scene.list("nodes", most_elements)) {
      const auto number = index(node, "nodes", nodes_);
      if (!taken.insert(number).second) node.fail(fmt::format("node {} is in the scene twice", number));
      plain["nodes"].push_back(number);
    }
    return plain;
  });
  if (const auto scene = root_.find("scene"))
    plain_["scene"] = index(*scene, "scenes", plain_.contains("scenes") ? plain_["scenes"].size() : 0);
}

// ---- Animations ----

Json Guard::copy_animation(const Json_value& animation) const {
  Json plain{{"samplers", Json::array()}, {"channels", Json::array()}};
  copy_name(animation, plain);
  // Exporters leave animations without a channel behind, which move nothing.
  for (const auto& sampler : animation.list("samplers", most_elements))
    plain["samplers"].push_back(copy_sampler(sampler));
  std::set<std::pair<std::size_t, std::string>> taken;
  for (const auto& channel : animation.list("channels", most_elements)) {
    const auto sampler = index(channel.at("sampler"), "samplers", plain["samplers"].size());
    const auto target = channel.at("target");
    // Skipped: a channel of an extension, or without a node, moves nothing that is read.
    const auto path = target.at("path").text();
    if (!target.has("node") || path == "pointer") continue;
    const auto node = index(target.at("node"), "nodes", nodes_);
    if (path == "weights" && targets_of(node) == 0) continue;  // as exporters write them for meshes without targets
    check_channel(target, plain["samplers"][sampler]);
    if (!taken.emplace(node, path).second)
      target.fail(fmt::format("another channel of the animation has the same target, the {} of node {}", path, node));
    plain["channels"].push_back({{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}});
  }
  return plain;
}

Json Guard::copy_sampler(const Json_value& sampler) const {
  const auto input = sampler.at("input");
  if (expect(input, "SCALAR", false).component != as_float) input.fail("expected times as floats");
  const auto interpolation = sampler.find("interpolation");
  return {{"input", accessor_index(input)},
          {"output", accessor_index(sampler.at("output"))},
          {"interpolation", interpolation ? interpolation->word({"LINEAR", "STEP", "CUBICSPLINE"}) : "LINEAR"}};
}

/// Checks that a sampler has as many keys as times, and of the type that the target takes.
void Guard::check_channel(const Json_value& target, const Json& sampler) const {
  const auto path = target.at("path").word({"translation", "rotation", "scale", "weights"});
  const auto& keys = accessors_[sampler["output"].get<std::size_t>()];
  const auto times = accessors_[sampler["input"].get<std::size_t>()].count;
  const std::string_view type = path == "weights" ? "SCALAR" : path == "rotation" ? "VEC4" : "VEC3";
  if (keys.type != type || !keys.readable)
    target.fail(fmt::format("expected keys of type {}, found {}", type, keys.type));
  const std::size_t per_time = sampler["interpolation"] == "CUBICSPLINE" ? 3 : 1;
  const auto wanted = times * per_time * numbers_per_key(target, path);
  if (keys.count != wanted) target.fail(fmt::format("{} times need {} keys, found {}", times, wanted, keys.count));
}

std::size_t Guard::numbers_per_key(const Json_value& target, const std::string& path) const {
  const auto& node = plain_["nodes"][target.at("node").count(0, nodes_ - 1)];
  if (path != "weights" && node.contains("matrix"))
    target.fail("the node has a matrix, so its parts cannot be animated");
  return path == "weights" ? targets_of(target.at("node").count(0, nodes_ - 1)) : 1;
}

/// Morph targets of the mesh of a node.
std::size_t Guard::targets_of(std::size_t node) const {
  const auto& plain = plain_["nodes"][node];
  return plain.contains("mesh") ? mesh_targets_[plain["mesh"].get<std::size_t>()] : 0;
}

}  // namespace

Guarded_gltf guard_gltf(const std::filesystem::path& file, std::uintmax_t max_bytes) {
  auto document = read_gltf_document(file, max_bytes);
  const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  check_asset(Json_value(document.json, document.name));  // before buffers, which extensions can leave out
  auto buffers = read_gltf_buffers(document, folder, max_bytes);
  auto plain = Guard(document, buffers).plain();
  return {.plain = std::move(plain),
          .buffers = std::move(buffers),
          .files = std::move(document.files),
          .not_read = unread_content(document.json),
          .ignored_extensions = ignored_extensions(document.json)};
}

}  // namespace lodestone
