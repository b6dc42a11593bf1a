// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tiny_gltf.h>
#include <cstdint>
#include <string>
#include <vector>

namespace lodestone {

/// The numbers of an accessor, one element after the other, with those of a sparse accessor in place, and normalized
/// integers as what they stand for. The guard has seen that all of them are there.
/// @param name  of the file, for messages
/// @throws Bad_mesh  a number that is not finite; indices of a sparse accessor out of order or range
std::vector<double> gltf_numbers(const tinygltf::Model& model, int accessor, const std::string& name);

/// The same for whole numbers.
std::vector<std::uint32_t> gltf_whole_numbers(const tinygltf::Model& model, int accessor, const std::string& name);

}  // namespace lodestone
