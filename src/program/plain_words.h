// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

namespace lodestone {

/// The words of a command line without `--`. A file after it whose name begins with `-` is written `./-NAME`, so that
/// it cannot be taken for an option, whatever is appended.
inline std::vector<std::string> plain_words(std::span<const std::string> words) {
  std::vector<std::string> plain;
  bool only_files = false;
  for (const auto& word : words) {
    if (!only_files && word == "--")
      only_files = true;
    else
      plain.push_back((only_files && word.size() > 1 && word.front() == '-' ? "./" : "") + word);
  }
  return plain;
}

}  // namespace lodestone
