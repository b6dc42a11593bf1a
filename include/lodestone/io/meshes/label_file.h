// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "lodestone/mesh/concepts.h"

/// Labels of regions in a text file: one region number per line, a line per vertex of the mesh file, in its order.
/// Empty lines do not count, nor does what follows a #.
namespace lodestone {

/// @param vertices  how many labels there must be
/// @return per vertex: its region, from 0 to one below their number
/// @throws Bad_mesh  no such file, a wrong number of labels, a label that is not a number, a region without a vertex
std::vector<Region_index> read_labels(const std::filesystem::path& file, std::size_t vertices);

/// The file appears whole or not at all.
/// @throws Bad_output
void write_labels(const std::filesystem::path& file, std::span<const Region_index> labels);

}  // namespace lodestone
