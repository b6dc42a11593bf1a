// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>

namespace lodestone {

/// Whether `name`, relative to `folder`, is inside the folder after symbolic links are resolved.
inline bool is_inside(const std::filesystem::path& folder, const std::string& name, std::error_code& error) {
  const auto inside = std::filesystem::weakly_canonical(folder, error);
  if (error) return false;
  const auto path = std::filesystem::weakly_canonical(inside / name, error);
  const auto [end, rest] = std::ranges::mismatch(inside, path);
  return !error && !std::filesystem::path(name).is_absolute() && end == inside.end() && rest != path.end();
}

inline bool is_inside(const std::filesystem::path& folder, const std::string& name) {
  std::error_code error;
  return is_inside(folder, name, error);
}

}  // namespace lodestone
