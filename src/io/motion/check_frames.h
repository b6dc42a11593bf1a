// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include "lodestone/io/formats/mesh_file_options.h"

namespace lodestone {

/// @throws Bad_motion  more frames than the limits allow
void check_frames(const std::string& name, std::size_t frames, const Mesh_file_options& limits);

}  // namespace lodestone
