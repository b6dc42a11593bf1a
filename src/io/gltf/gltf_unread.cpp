// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/gltf/gltf_unread.h"

#include <algorithm>

namespace lodestone {

std::set<std::string> ignored_extensions(const nlohmann::json& document) {
  std::set<std::string> result;
  const nlohmann::json::json_pointer copies("/extensions/EXT_mesh_gpu_instancing");
  const nlohmann::json::json_pointer visible("/extensions/KHR_node_visibility/visible");
  for (const auto& node : document.value("nodes", nlohmann::json::array())) {
    if (node.contains(copies)) result.insert("EXT_mesh_gpu_instancing");
    if (node.contains(visible) && node[visible] == false) result.insert("KHR_node_visibility");
  }
  const nlohmann::json::json_pointer pointer("/target/extensions/KHR_animation_pointer/pointer");
  for (const auto& animation : document.value("animations", nlohmann::json::array()))
    for (const auto& channel : animation.value("channels", nlohmann::json::array())) {
      if (!channel.contains(pointer) || !channel[pointer].is_string()) continue;
      const auto moved = channel[pointer].get<std::string>();  // others are materials, lights or cameras
      if (moved.starts_with("/nodes/") || moved.starts_with("/meshes/")) result.insert("KHR_animation_pointer");
    }
  return result;
}

std::set<std::string> unread_content(const nlohmann::json& document) {
  std::set<std::string> result;
  if (document.contains("materials")) result.insert("materials");
  const auto nodes = document.value("nodes", nlohmann::json::array());
  if (std::ranges::count_if(nodes, [](const nlohmann::json& node) { return node.contains("mesh"); }) > 1)
    result.insert("groups");
  for (const auto& mesh : document.value("meshes", nlohmann::json::array()))
    for (const auto& primitive : mesh.value("primitives", nlohmann::json::array())) {
      const auto mode = primitive.find("mode");
      if (mode != primitive.end() && mode->is_number() && *mode < 4) result.insert(*mode == 0 ? "points" : "lines");
      const auto attributes = primitive.value("attributes", nlohmann::json::object());
      if (attributes.contains("TEXCOORD_0")) result.insert("texture coordinates");
      if (attributes.contains("COLOR_0")) result.insert("colours");
      if (attributes.contains("NORMAL")) result.insert("normals");
    }
  return result;
}

}  // namespace lodestone
