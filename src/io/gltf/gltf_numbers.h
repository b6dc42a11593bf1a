// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tiny_gltf.h>
#include <cstdint>
#include <string>
#include <vector>

namespace lodestone {

/// The numbers of an accessor, element by element, with sparse elements substituted and normalized integers converted.
/// Requires that the guard has checked the sizes.
/// @param name  file name, for messages
/// @throws Bad_mesh  a number that is not finite; indices of a sparse accessor out of order or range
std::vector<double> gltf_numbers(const tinygltf::Model& model, int accessor, const std::string& name);

/// The same for integers.
std::vector<std::uint32_t> gltf_whole_numbers(const tinygltf::Model& model, int accessor, const std::string& name);

}  // namespace lodestone
