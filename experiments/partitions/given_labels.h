// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "lodestone/partition/strategies.h"

namespace lodestone {

struct Partition_variant;

/// The labels of one mesh of the experiment, as another tool made them.
struct Given_labels {
  std::string mesh = {};
  std::size_t regions = 0;  ///< the number of regions with which they are compared; there may be more or fewer
  std::string hash = {};    ///< of the labels: runs with other labels are other runs
  std::shared_ptr<const std::vector<Region_index>> labels = {};
};

/// A strategy that gives these labels. The ball that collides with the mesh is divided by `lbg`.
/// @param name  of the strategy; must outlive the result
Any_strategy strategy_of(const Given_labels& labels, std::string_view name);

/// Strategies whose labels lie in files: `NAME/MESH.REGIONS.labels`, or `NAME/MESH.labels` for 32 regions. Each folder
/// NAME is a strategy of that name, for the meshes whose labels it has.
/// @param given  folders, `FOLDER/*.labels`, or files
/// @throws Bad_argument  no file, a file of no mesh, a name of the experiment's own strategies, a number of regions
///                       that the experiment does not compare, two files for the same
/// @throws Bad_mesh      as read_labels
std::vector<Partition_variant> read_given_labels(const std::vector<std::filesystem::path>& given);

}  // namespace lodestone
