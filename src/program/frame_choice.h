// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace lodestone {

/// The frames of `FIRST:LAST:STEP`, including the last.
struct Frame_choice {
  std::size_t first = 0;
  std::size_t last = 0;
  std::size_t step = 1;
};

/// Reads the option --frames. Each part may be omitted; an empty text chooses all frames, a single number one frame.
/// @param frames  number of frames there are, > 0
/// @throws Bad_argument
Frame_choice parse_frames(const std::string& choice, std::size_t frames);

std::vector<std::size_t> list_of(const Frame_choice& choice);

}  // namespace lodestone
