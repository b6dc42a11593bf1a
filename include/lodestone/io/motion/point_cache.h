// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>

namespace lodestone {

/// PC2: Blender, 3ds Max, Maya; little endian, with a signature. MDD: LightWave, Blender, Houdini; big endian, no
/// signature.
enum class Cache_format {
  pc2,  ///< Blender, 3ds Max, Maya
  mdd,  ///< LightWave, Blender, Houdini
};

/// The header of a point cache.
struct Point_cache {
  Cache_format format = Cache_format::pc2;  ///< by the extension
  std::size_t vertices = 0;                 ///< positions per frame
  std::size_t frames = 0;                   ///< how many the file has
  double frames_per_second = 0;             ///< from the times of an MDD cache; 0: unknown
  double start = 0;                         ///< time of its first frame in seconds, if they are known
};

/// Reads the header of a point cache, in the format of its extension (`.pc2`, `.mdd`), and checks it against the file's
/// size.
/// @throws Bad_motion  no such file, another extension, not a cache of that format, shorter than its header says
Point_cache read_point_cache_header(const std::filesystem::path& file);

}  // namespace lodestone
