// SPDX-License-Identifier: GPL-3.0-or-later
// A folder of shards, as the program merges it.
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/scratch_folder.h"
#include "program/frame_tally.h"
#include "program/shards.h"

namespace {

using namespace lodestone::fuzz;
using lodestone::Shard_folder;

constexpr std::size_t most_shards = 4;

/// The parts of the input between zero bytes.
std::vector<std::string> parts_of(std::string_view text) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == '\0')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

std::filesystem::path empty_folder() {
  const auto folder = scratch().path() / "shards";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directory(folder);
  return scratch().path();
}

/// Every other line is the tally of a frame, as in shards of `lodestone detect`.
std::string merged(const Shard_folder& folder) {
  std::string lines;
  bool is_tally = false;
  folder.read_all([&](std::string_view line) {
    if (is_tally) to_json(lodestone::frame_tally_of(lodestone::parse_shard_line(line)));
    lines.append(line) += '\n';
    is_tally = !is_tally;
  });
  return lines;
}

/// Manifest and shards are any bytes.
void merge_any(const std::vector<std::string>& parts) {
  const auto results = empty_folder();
  scratch().write("shards/manifest.json", parts.front());
  accepts([&] {
    const Shard_folder folder(results);
    for (std::size_t i = 1; i < std::min(parts.size(), most_shards + 1); ++i)
      scratch().write("shards/" + folder.file(i).filename().string(), parts[i]);
    folder.status(1, lodestone::Shard_check::all);
    folder.is_merged();
    merged(folder);
  });
}

/// A part as lines, up to the last line break.
std::vector<std::string> lines_of(const std::string& part) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0, end = 0; (end = part.find('\n', begin)) != part.npos; begin = end + 1)
    lines.push_back(part.substr(begin, end - begin));
  return lines;
}

/// Shards that were written by the program, with any lines: merged, they are what was written.
void write_and_merge(const std::vector<std::string>& parts) {
  const auto results = empty_folder();
  const std::size_t count = std::min(parts.size(), most_shards);
  const lodestone::Work work{.command = {"detect", "scene.json"}, .shards = count, .pieces = count, .inputs = {}};
  const Shard_folder folder(results, work, lodestone::Shard_use::make);
  std::string unsharded;
  for (std::size_t i = 0; i < count; ++i) {
    lodestone::Shard_writer writer(folder, i + 1);
    for (const auto& line : lines_of(parts[i])) {
      writer.add(line);
      unsharded += line + '\n';
    }
    writer.commit();
  }
  std::string lines;
  folder.read_all([&](std::string_view line) { lines.append(line) += '\n'; });
  require(lines == unsharded, "merged shards differ from what was written");
  accepts([&] { merged(folder); });
}

}  // namespace

// The first byte chooses; zero bytes separate the manifest and the shards.
LODESTONE_FUZZ_TARGET(shards) {
  const std::string_view text(reinterpret_cast<const char*>(input.data()), input.size());
  const auto parts = parts_of(text.substr(std::min<std::size_t>(1, text.size())));
  if (!text.empty() && text.front() == 'w')
    write_and_merge(parts);
  else
    merge_any(parts);
}
