// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace lodestone {

/// Control points of the Utah teapot in the format that `bezier_patches` reads.
extern const char* const teapot_patches;

}  // namespace lodestone
