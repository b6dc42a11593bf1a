// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace lodestone {

/// Options of `read_mesh`.
struct Mesh_file_options {
  std::size_t max_faces = 50'000'000;  ///< files that have or announce more faces are refused
};

}  // namespace lodestone
