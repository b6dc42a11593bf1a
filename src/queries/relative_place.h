// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace lodestone::kernel {

/// Relative coordinates: see `Ray_tree`.
struct Relative_place {
  double middle[3];
  double scale;
};

}  // namespace lodestone::kernel
