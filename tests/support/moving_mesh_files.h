// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "support/scene_samples.h"

/// Meshes with point caches, in a few lines.
namespace lodestone::test {

/// Writes `PATH.off`, the tetrahedron of `tetrahedron_off(x)`, and `PATH.pc2`, in which it moves by `step` along the
/// x-axis from frame to frame.
inline void write_moving_tetrahedron(const std::filesystem::path& path, int frames, int x = 0, float step = 0) {
  std::ofstream(path.string() + ".off") << tetrahedron_off(x);
  std::string bytes("POINTCACHE2\0", 12);
  const auto append = [&](auto value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  };
  for (const std::int32_t value : {1, 4}) append(value);  // version, points
  for (const float value : {0.0F, 1.0F}) append(value);   // first frame, distance of frames
  append(std::int32_t{frames});
  for (int frame = 0; frame < frames; ++frame) {
    const float here = static_cast<float>(x) + step * static_cast<float>(frame);
    for (const float value : {here, 0.0F, 0.0F, here + 1, 0.0F, 0.0F, here, 1.0F, 0.0F, here, 0.0F, 1.0F})
      append(value);
  }
  std::ofstream(path.string() + ".pc2", std::ios::binary) << bytes;
}

}  // namespace lodestone::test
