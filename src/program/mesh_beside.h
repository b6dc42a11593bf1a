// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <filesystem>

#include "lodestone/mesh/errors.h"

namespace lodestone {

/// Refuses `--mesh` beside a scene, an object of one, or a built-in shape.
/// @throws Bad_argument  a mesh is given
inline void refuse_mesh_beside(const std::filesystem::path& input, const std::filesystem::path& mesh) {
  if (!mesh.empty()) throw Bad_argument(fmt::format("{}: only a point cache needs a mesh beside it", input.string()));
}

}  // namespace lodestone
