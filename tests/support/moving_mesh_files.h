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

/// Writes `PATH.off`, one mesh of two tetrahedra that share no vertex, and `PATH.pc2`. The one whose vertices come last
/// has the first face. It moves by -1 along the x-axis from frame to frame, from x = 2.5 on; the other stays at x = 0.
inline void write_two_tetrahedra_in_one_mesh(const std::filesystem::path& path, int frames) {
  std::ofstream(path.string() + ".off")
      << "OFF\n8 8 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n2.5 0 0\n3.5 0 0\n2.5 1 0\n2.5 0 1\n"
         "3 4 6 5\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n3 4 5 7\n3 5 6 7\n3 4 7 6\n";
  std::string bytes = std::string("POINTCACHE2\0", 12) + packed<std::int32_t>({1, 8}) + packed<float>({0, 1}) +
                      packed<std::int32_t>({double(frames)});
  for (int frame = 0; frame < frames; ++frame)
    for (const double x : {0.0, 2.5 - frame}) bytes += packed<float>({x, 0, 0, x + 1, 0, 0, x, 1, 0, x, 0, 1});
  std::ofstream(path.string() + ".pc2", std::ios::binary) << bytes;
}

}  // namespace lodestone::test
