// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace lodestone {

/// The rows of a sweep as tables in Markdown: measures and use of partitions into 32 regions, recall against the number
/// of regions, the weight of the normals, island repair. A figure is first the mean over the meshes of one seed (the
/// median for times), then the mean over the seeds. It has its 95 % confidence interval: proportions as
/// `0.973 (0.961..0.981)`, other figures as `17.9 +- 0.3`.
std::string partition_report(const std::map<std::string, nlohmann::ordered_json>& rows);

/// The same figures for plots: one entry per variant, number of regions and figure, with its interval, over all meshes;
/// for 32 regions also of each mesh.
nlohmann::ordered_json partition_figures(const std::map<std::string, nlohmann::ordered_json>& rows);

}  // namespace lodestone
