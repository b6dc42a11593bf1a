// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace lodestone {

/// Per vertex of a file: the first of those that always are at its place, which faces name instead of it. Formats with
/// one texture coordinate per vertex, glTF and MD3, list a vertex several times along the seams of a texture. Empty: no
/// two vertices are joined.
using Joined_vertices = std::vector<std::uint32_t>;

}  // namespace lodestone
