// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "support/mesh_samples.h"
#include "support/scene_samples.h"

/// Meshes with point caches, in a few lines.
namespace lodestone::test {

/// Writes `PATH.off`, the tetrahedron of `tetrahedron_off(x)`, and `PATH.pc2`, in which it moves by `step` along the
/// x-axis from frame to frame.
inline void write_moving_tetrahedron(const std::filesystem::path& path, int frames, int x = 0, double step = 0) {
  std::ofstream(path.string() + ".off") << tetrahedron_off(x);
  std::string bytes = std::string("POINTCACHE2\0", 12) + packed<std::int32_t>({1, 4}) + packed<float>({0, 1}) +
                      packed<std::int32_t>({double(frames)});
  for (int frame = 0; frame < frames; ++frame) {
    const double here = x + step * frame;
    bytes += packed<float>({here, 0, 0, here + 1, 0, 0, here, 1, 0, here, 0, 1});
  }
  std::ofstream(path.string() + ".pc2", std::ios::binary) << bytes;
}

}  // namespace lodestone::test
