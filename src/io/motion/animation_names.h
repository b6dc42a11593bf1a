// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>

#include "io/files/json_reader.h"

namespace lodestone {

/// The name of an animation in quotes; its number, if it has none, as `0 (unnamed)`.
inline std::string animation_name(std::span<const std::string> names, std::size_t animation) {
  const auto& name = names[animation];
  return name.empty() ? std::to_string(animation) + " (unnamed)" : detail::quoted_name(name);
}

/// `'idle', 'walk'`: the names of animations, on one line that is not too long.
inline std::string animation_list(std::span<const std::string> names) {
  constexpr std::size_t most = 20;
  const std::size_t shown = std::min(names.size(), most);
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) text += (i > 0 ? ", " : "") + animation_name(names, i);
  if (shown < names.size()) text += ", and " + std::to_string(names.size() - shown) + " more";
  return text;
}

}  // namespace lodestone
