// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numbers>

#include "certified/made_character.h"
#include "lodestone/io/files/atomic_file.h"

namespace lodestone {

namespace {

using nlohmann::json;
static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

constexpr double keys_per_second = 4;  ///< few: the curves between keys make the motion

/// The only buffer of a file, and the parts of the document that say what lies in it.
class Glb_buffer {
 public:
  /// Adds an accessor of one row per element.
  /// @param type  VEC3 and the like
  template <class Number>
  std::size_t add(const char* type, const std::vector<std::vector<Number>>& rows, bool with_range = false) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    const std::size_t offset = bytes_.size();
    for (const auto& row : rows) bytes_.append(reinterpret_cast<const char*>(row.data()), row.size() * sizeof(Number));
    views_.push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes_.size() - offset}});
    accessors_.push_back({{"bufferView", views_.size() - 1},
                          {"componentType", component_type(Number{})},
                          {"count", rows.size()},
                          {"type", type}});
    if (with_range) add_range(rows);
    return accessors_.size() - 1;
  }

  /// The whole file.
  std::string file(json document) const {
    document["bufferViews"] = views_;
    document["accessors"] = accessors_;
    document["buffers"] = {{{"byteLength", bytes_.size()}}};
    std::string text = document.dump(), body = bytes_;
    text.resize((text.size() + 3) / 4 * 4, ' ');
    body.resize((body.size() + 3) / 4 * 4);
    return "glTF" + number(2) + number(28 + text.size() + body.size()) + number(text.size()) + "JSON" + text +
           number(body.size()) + std::string("BIN\0", 4) + body;
  }

 private:
  static int component_type(float) { return 5126; }
  static int component_type(std::uint32_t) { return 5125; }
  static int component_type(std::uint8_t) { return 5121; }
  static std::string number(std::size_t value) {
    const auto raw = std::bit_cast<std::array<char, 4>>(static_cast<std::uint32_t>(value));
    return {raw.data(), raw.size()};
  }
  template <class Number>
  void add_range(const std::vector<std::vector<Number>>& rows) {
    auto low = rows.front(), high = rows.front();
    for (const auto& row : rows)
      for (std::size_t i = 0; i < row.size(); ++i)
        low[i] = std::min(low[i], row[i]), high[i] = std::max(high[i], row[i]);
    accessors_.back()["min"] = low;
    accessors_.back()["max"] = high;
  }

  std::string bytes_;
  json views_ = json::array(), accessors_ = json::array();
};

std::vector<float> floats(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

Eigen::Vector3d vector_of(const Point& p) { return {p.x(), p.y(), p.z()}; }

class Character_writer {
 public:
  explicit Character_writer(const Made_character& character)
      : character_(character), mesh_(capsule_surface(character.capsules, character.surface)) {
    document_ = {{"asset", {{"version", "2.0"}, {"generator", "Lodestone"}}}, {"scene", 0}};
    document_["nodes"] = {{{"name", character.name}, {"mesh", 0}}};
    document_["scenes"] = {{{"nodes", {0}}}};
  }

  std::string file() {
    add_mesh();
    if (!character_.joints.empty()) add_skin();
    add_animation();
    return buffer_.file(document_);
  }

 private:
  void add_mesh() {
    std::vector<std::vector<float>> positions;
    for (const auto v : mesh_.vertices()) positions.push_back(floats(vector_of(mesh_.point(v))));
    std::vector<std::vector<std::uint32_t>> corners;
    for (const auto f : mesh_.faces())
      for (const auto v : mesh_.vertices_around_face(mesh_.halfedge(f)))
        corners.push_back({static_cast<std::uint32_t>(v.idx())});
    json primitive = {{"attributes", {{"POSITION", buffer_.add("VEC3", positions, true)}}},
                      {"indices", buffer_.add("SCALAR", corners)}};
    document_["meshes"] = {{{"name", character_.name}}};
    for (const auto& target : character_.targets) {
      std::vector<std::vector<float>> offsets;
      for (const auto v : mesh_.vertices()) offsets.push_back(floats(target.offset_at(vector_of(mesh_.point(v)))));
      primitive["targets"].push_back({{"POSITION", buffer_.add("VEC3", offsets, true)}});
      document_["meshes"][0]["weights"].push_back(0);
      document_["meshes"][0]["extras"]["targetNames"].push_back(target.name);
    }
    document_["meshes"][0]["primitives"] = json::array({primitive});
  }

  /// Joints are the nodes 1, 2, ..., in their order.
  void add_skin() {
    std::vector<std::vector<std::uint8_t>> joints;
    std::vector<std::vector<float>> weights, inverses;
    for (const auto v : mesh_.vertices()) {
      joints.emplace_back(4, std::uint8_t{0});
      weights.emplace_back(4, 0.0F);
      std::size_t slot = 0;
      for (const auto& [joint, weight] : joints_at(character_, vector_of(mesh_.point(v)))) {
        joints.back()[slot] = static_cast<std::uint8_t>(joint);
        weights.back()[slot++] = static_cast<float>(weight);
      }
    }
    for (std::size_t i = 0; i < character_.joints.size(); ++i) {
      const auto& joint = character_.joints[i];
      const bool is_root = i == 0;
      const auto at = floats(-joint.at);
      inverses.push_back({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, at[0], at[1], at[2], 1});
      const Eigen::Vector3d place = is_root ? joint.at : joint.at - character_.joints[joint.parent].at;
      document_["nodes"].push_back({{"name", joint.name}, {"translation", floats(place)}});
      document_["skins"][0]["joints"].push_back(i + 1);
      if (is_root)
        document_["scenes"][0]["nodes"].push_back(1);
      else
        document_["nodes"][joint.parent + 1]["children"].push_back(i + 1);
    }
    auto& attributes = document_["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = buffer_.add("VEC4", joints);
    attributes["WEIGHTS_0"] = buffer_.add("VEC4", weights);
    document_["skins"][0]["inverseBindMatrices"] = buffer_.add("MAT4", inverses);
    document_["nodes"][0]["skin"] = 0;
  }

  void add_animation() {
    const auto keys = static_cast<std::size_t>(character_.seconds * keys_per_second) + 1;
    std::vector<std::vector<float>> times;
    for (std::size_t key = 0; key < keys; ++key) times.push_back({static_cast<float>(key / keys_per_second)});
    const std::size_t input = buffer_.add("SCALAR", times, true);
    const auto wave = [&](std::size_t key, double turns, double phase) {
      const double t = static_cast<double>(key) / static_cast<double>(keys - 1);
      return std::sin(2 * std::numbers::pi * (turns * t + phase));
    };
    for (std::size_t i = 0; i < character_.joints.size(); ++i) {
      const auto& joint = character_.joints[i];
      std::vector<std::vector<float>> rotations;
      for (std::size_t key = 0; key < keys; ++key) {
        const double half = 0.5 * (joint.middle + joint.swing * wave(key, joint.turns, joint.phase));
        auto rotation = floats(std::sin(half) * joint.axis);
        rotation.push_back(static_cast<float>(std::cos(half)));
        rotations.push_back(std::move(rotation));
      }
      add_channel(i + 1, "rotation", input, buffer_.add("VEC4", rotations));
    }
    std::vector<std::vector<float>> weights;
    for (std::size_t key = 0; key < keys; ++key)
      for (const auto& target : character_.targets)
        weights.push_back({static_cast<float>(0.5 * (1 + wave(key, target.turns, target.phase)))});
    if (!weights.empty()) add_channel(0, "weights", input, buffer_.add("SCALAR", weights));
  }
  void add_channel(std::size_t node, const char* path, std::size_t input, std::size_t output) {
    auto& animation = document_["animations"][0];
    animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", "LINEAR"}});
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
  }

  const Made_character& character_;
  Surface_mesh mesh_;
  Glb_buffer buffer_;
  json document_;
};

}  // namespace

void write_glb(const Made_character& character, const std::filesystem::path& path) {
  write_whole(path, Character_writer(character).file());
}

}  // namespace lodestone
