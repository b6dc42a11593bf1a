// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/frame_choice.h"

#include <fmt/format.h>

#include <charconv>
#include <string_view>

#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

std::size_t number(std::string_view text, std::size_t otherwise, const std::string& choice) {
  if (text.empty()) return otherwise;
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw Bad_argument(fmt::format("--frames {}: expected FIRST:LAST:STEP", choice));
  return value;
}

std::vector<std::string> split(const std::string& choice) {
  std::vector<std::string> parts(1);
  for (const char c : choice) {
    if (c == ':')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

}  // namespace

Frame_choice parse_frames(const std::string& choice, std::size_t frames) {
  const auto parts = split(choice);
  if (parts.size() > 3) throw Bad_argument(fmt::format("--frames {}: expected FIRST:LAST:STEP", choice));
  const auto last = frames - 1;
  Frame_choice result{.first = number(parts[0], 0, choice)};
  result.last = parts.size() > 1 ? number(parts[1], last, choice) : choice.empty() ? last : result.first;
  if (parts.size() > 2) result.step = number(parts[2], 1, choice);
  if (result.step == 0) throw Bad_argument(fmt::format("--frames {}: the step must be 1 or more", choice));
  if (result.first > last || result.last > last)
    throw Bad_argument(fmt::format("--frames {}: the frames are 0 to {}", choice, last));
  if (result.first > result.last)
    throw Bad_argument(fmt::format("--frames {}: the range is empty: its first frame, {}, comes after its last, {}",
                                   choice, result.first, result.last));
  return result;
}

std::vector<std::size_t> list_of(const Frame_choice& choice) {
  std::vector<std::size_t> frames;
  for (auto frame = choice.first; frame <= choice.last; frame += choice.step) {
    frames.push_back(frame);
    if (choice.last - frame < choice.step) break;  // the sum might overflow
  }
  return frames;
}

}  // namespace lodestone
