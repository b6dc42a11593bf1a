// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace lodestone {

/// What readers take at most. Lower these where files of strangers are read: they bound memory and time.
struct Mesh_file_options {
  std::size_t max_faces = 50'000'000;  ///< files that have or announce more faces are refused
  /// So are longer files, and glTF files whose buffers are longer together. Enough for 50 million faces as text.
  std::uintmax_t max_bytes = std::uintmax_t{16} << 30U;
  std::size_t max_frames = 1'000'000;  ///< so are animations and scenes of more frames
};

}  // namespace lodestone
