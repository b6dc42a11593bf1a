// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/mesh_samples.h"

/// Builds glTF files piece by piece.
namespace lodestone::test {

std::string base64(const std::string& bytes);

/// A file with one buffer.
struct Gltf_sample {
  nlohmann::json json = {{"asset", {{"version", "2.0"}}}};
  std::string bytes = {};

  /// Adds a buffer view of these bytes and returns its index.
  std::size_t add_view(const std::string& content) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", content.size()}});
    bytes += content;
    return json["bufferViews"].size() - 1;
  }
  std::size_t add_accessor(nlohmann::json accessor) {
    json["accessors"].push_back(std::move(accessor));
    return json["accessors"].size() - 1;
  }
  std::size_t add_floats(const char* type, std::size_t width, std::initializer_list<double> values) {
    return add_accessor({{"bufferView", add_view(packed<float>(values))},
                         {"componentType", 5126},
                         {"count", values.size() / width},
                         {"type", type}});
  }
  std::size_t add_points(std::initializer_list<double> values) { return add_floats("VEC3", 3, values); }
  std::size_t add_numbers(std::initializer_list<double> values) { return add_floats("SCALAR", 1, values); }
  std::size_t add_quaternions(std::initializer_list<double> values) { return add_floats("VEC4", 4, values); }
  std::size_t add_indices(std::initializer_list<double> values) {
    return add_accessor({{"bufferView", add_view(packed<std::uint16_t>(values))},
                         {"componentType", 5123},
                         {"count", values.size()},
                         {"type", "SCALAR"}});
  }
  /// A curve of a node in the only animation.
  void animate(std::size_t node, const char* path, std::size_t times, std::size_t values,
               const char* interpolation = "LINEAR") {
    auto& animation = json["animations"][0];
    animation["name"] = "walk";
    animation["samplers"].push_back({{"input", times}, {"output", values}, {"interpolation", interpolation}});
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
  }

  std::string gltf(const std::string& uri) const {
    auto document = json;
    document["buffers"] = {{{"byteLength", bytes.size()}, {"uri", uri}}};
    return document.dump();
  }
  std::string gltf() const { return gltf("data:application/octet-stream;base64," + base64(bytes)); }
  std::string glb() const {
    auto document = json;
    document["buffers"] = {{{"byteLength", bytes.size()}}};
    auto text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    auto body = bytes;
    body.resize((body.size() + 3) / 4 * 4);
    const auto number = [](std::size_t value) { return packed<std::uint32_t>({static_cast<double>(value)}); };
    return "glTF" + number(2) + number(28 + text.size() + body.size()) + number(text.size()) + "JSON" + text +
           number(body.size()) + std::string("BIN\0", 4) + body;
  }
};

/// The square of mesh_samples.h at a node.
Gltf_sample square_gltf();

/// The square with two animations of a second, `idle` and `walk`.
Gltf_sample square_with_two_animations();

/// A file with every feature: a node with a child, a skin of two joints, two morph targets, one of them sparse, and
/// curves of all kinds over two seconds.
Gltf_sample rich_gltf();

}  // namespace lodestone::test
