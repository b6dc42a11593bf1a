// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lodestone/io/scenes/scene_file.h"
#include "lodestone/partition/strategies.h"
#include "partitions/given_labels.h"

namespace lodestone {

/// A strategy with its settings, and its name in the tables.
struct Partition_variant {
  std::string name;
  std::string_view strategy;
  Strategy_settings settings = {};
  Partition_options options = {};
  std::vector<Given_labels> labels = {};  ///< not empty: these in place of a strategy of the library
};

/// A surface that is divided, at one resolution.
struct Partition_mesh {
  std::string_view name;        ///< with its resolution
  Surface_mesh (*make)();       ///< about one unit in radius
  Surface_mesh (*make_ball)();  ///< the sphere that collides with it: unit radius, about the same edge length
};

struct Partition_run {
  Partition_variant variant;
  Partition_mesh mesh;
  std::size_t regions = 0;
  std::uint64_t seed = 0;

  /// Made from the parameters, such as `teapot_fine/lbg/N32/seed1`.
  std::string id() const;
  /// The labels of this mesh in so many regions; null for a strategy of the library.
  const Given_labels* labels() const;
  /// Must not outlive the run.
  Any_strategy strategy() const;
};

/// All strategies of the registry, `lbg` also with its other split, without island repair, and with other weights of
/// the normals.
std::vector<Partition_variant> partition_variants();
/// Teapot, sphere, torus knot and cloth, at about 2 000 and 10 000 triangles.
std::span<const Partition_mesh> partition_meshes();

inline constexpr std::size_t partition_counts[] = {8, 12, 32, 64, 128};
inline constexpr std::uint64_t partition_seeds[] = {1, 2, 3, 4, 5};

/// All combinations, without the meshes that are too large for a strategy.
/// @param only   names of meshes and variants; naming a mesh leaves out all other meshes, and the same for variants
/// @param given  further variants, whose labels are given
/// @throws Bad_argument  a name that is neither
std::vector<Partition_run> partition_plan(const std::vector<std::string>& only = {},
                                          const std::vector<Partition_variant>& given = {});

/// Writes each mesh as `NAME.off`, for tools that label its vertices.
/// @throws Bad_output
void write_partition_meshes(const std::filesystem::path& folder);

/// The mesh wobbles, while a ball half its size visits three places of its surface, which the seed chooses, and
/// presses into each.
Scene partition_scene(const Partition_mesh& mesh, std::uint64_t seed);

}  // namespace lodestone
