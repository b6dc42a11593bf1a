// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/gltf/gltf_size.h"

#include <fmt/format.h>

#include <algorithm>

#include "lodestone/mesh/errors.h"

namespace lodestone {
namespace {

/// Of an accessor; 0: there is none.
double numbers_of_accessor(const tinygltf::Model& model, int number) {
  if (number < 0) return 0;
  const auto& accessor = model.accessors[static_cast<std::size_t>(number)];
  return static_cast<double>(accessor.count) *
         tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
}

/// Of all targets together: each that moves any vertex of a mesh has an offset for every one.
double numbers_of_targets(const tinygltf::Mesh& mesh, double positions) {
  std::size_t targets = 0;
  for (const auto& primitive : mesh.primitives) targets = std::max(targets, primitive.targets.size());
  const auto moves = [](const auto& target) { return target.contains("POSITION"); };
  std::size_t moving = 0;
  for (const auto& primitive : mesh.primitives)
    moving += static_cast<std::size_t>(std::ranges::count_if(primitive.targets, moves));
  return positions * static_cast<double>(std::min(moving, targets));
}

/// Of a mesh, as Shape_reader keeps it: every vertex has as many joints as any.
double numbers_of_mesh(const tinygltf::Model& model, const tinygltf::Mesh& mesh) {
  double positions = 0, corners = 0;
  std::size_t influences = 0;
  for (const auto& primitive : mesh.primitives) {
    const double own = numbers_of_accessor(model, primitive.attributes.at("POSITION"));
    positions += own;
    corners += primitive.indices < 0 ? own / 3 : numbers_of_accessor(model, primitive.indices);
    const auto is_joints = [](const auto& attribute) { return attribute.first.starts_with("JOINTS_"); };
    influences =
        std::max(influences, 4 * static_cast<std::size_t>(std::ranges::count_if(primitive.attributes, is_joints)));
  }
  // A strip has three corners of a face for each corner that is listed.
  return positions + 3 * corners + 2 * positions / 3 * static_cast<double>(influences) +
         numbers_of_targets(mesh, positions);
}

/// Of the mesh and the skin that a node shows.
double numbers_of_node(const tinygltf::Model& model, const tinygltf::Node& node) {
  if (node.mesh < 0) return 0;
  const double mesh = numbers_of_mesh(model, model.meshes[static_cast<std::size_t>(node.mesh)]);
  if (node.skin < 0) return mesh;
  return mesh + 16 * static_cast<double>(model.skins[static_cast<std::size_t>(node.skin)].joints.size());
}

double numbers_of_animation(const tinygltf::Model& model, const tinygltf::Animation& animation) {
  double numbers = 0;
  for (const auto& channel : animation.channels) {
    const auto& sampler = animation.samplers[static_cast<std::size_t>(channel.sampler)];
    numbers += numbers_of_accessor(model, sampler.input) + numbers_of_accessor(model, sampler.output);
  }
  return numbers;
}

}  // namespace

void check_gltf_size(const tinygltf::Model& model, const std::string& name, const Mesh_file_options& options) {
  double numbers = 0;
  for (const auto& node : model.nodes) numbers += numbers_of_node(model, node);
  for (const auto& animation : model.animations) numbers += numbers_of_animation(model, animation);
  const double most = std::max(1e6, 20 * static_cast<double>(options.max_faces));
  if (numbers > most)
    throw Bad_mesh(
        fmt::format("{}: the shown meshes and the animations have {:.0f} numbers, where at most {:.0f} are allowed",
                    name, numbers, most));
}

}  // namespace lodestone
