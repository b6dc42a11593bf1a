// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/gltf_samples.h"

namespace lodestone::test {

std::string base64(const std::string& bytes) {
  constexpr auto* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : letters[bits >> (18 - 6 * k) & 63U];
  }
  return text;
}

Gltf_sample square_gltf() {
  Gltf_sample sample;
  const auto points = sample.add_points({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  const auto corners = sample.add_indices({0, 1, 2, 0, 2, 3});
  sample.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", points}}}, {"indices", corners}}}}}};
  sample.json["nodes"] = {{{"mesh", 0}}};
  sample.json["scenes"] = {{{"nodes", {0}}}};
  sample.json["scene"] = 0;
  return sample;
}

Gltf_sample square_with_two_animations() {
  auto sample = square_gltf();
  sample.animate(0, "translation", sample.add_numbers({0, 1}), sample.add_points({0, 0, 0, 0, 0, 1}));
  auto walk = sample.json["animations"][0];
  walk["samplers"][0]["output"] = sample.add_points({0, 0, 5, 0, 0, 6});
  sample.json["animations"][0]["name"] = "idle";
  sample.json["animations"].push_back(walk);
  return sample;
}

Gltf_sample rich_gltf() {
  auto sample = square_gltf();
  auto& json = sample.json;
  const auto lifted = sample.add_points({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  const auto indices = sample.add_view(packed<std::uint16_t>({2, 3}));
  const auto values = sample.add_view(packed<float>({1, 0, 0, 0, 1, 0}));
  const auto sparse = sample.add_accessor({{"componentType", 5126},
                                           {"count", 4},
                                           {"type", "VEC3"},
                                           {"sparse",
                                            {{"count", 2},
                                             {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                             {"values", {{"bufferView", values}}}}}});
  auto& primitive = json["meshes"][0]["primitives"][0];
  primitive["targets"] = {{{"POSITION", lifted}}, {{"POSITION", sparse}}};
  json["meshes"][0]["weights"] = {0, 0.5};
  const auto joints = sample.add_view(packed<std::uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}));
  const auto weights =
      sample.add_view(packed<std::uint8_t>({255, 0, 0, 0, 128, 127, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0}));
  primitive["attributes"]["JOINTS_0"] =
      sample.add_accessor({{"bufferView", joints}, {"componentType", 5121}, {"count", 4}, {"type", "VEC4"}});
  primitive["attributes"]["WEIGHTS_0"] = sample.add_accessor(
      {{"bufferView", weights}, {"componentType", 5121}, {"normalized", true}, {"count", 4}, {"type", "VEC4"}});
  const auto matrices = sample.add_floats(
      "MAT4", 16, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1});
  json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", matrices}}};
  json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"children", {1}}},
                   {{"children", {2}}, {"rotation", {0, 0, 0, 1}}},
                   {{"translation", {1, 0, 0}}, {"scale", {1, 1, 1}}}};
  const auto times = sample.add_numbers({0, 1, 2});
  sample.animate(1, "rotation", times, sample.add_quaternions({0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1}));
  sample.animate(2, "translation", times, sample.add_points({1, 0, 0, 1, 1, 0, 1, 0, 1}), "STEP");
  sample.animate(2, "scale", sample.add_numbers({0, 2}),
                 sample.add_points({0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0, 2, 2, 2, 0, 0, 0}), "CUBICSPLINE");
  sample.animate(0, "weights", times, sample.add_numbers({0, 0.5, 1, 0, 0, 1}));
  return sample;
}

}  // namespace lodestone::test
