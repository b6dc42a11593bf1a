// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a fuzz target on every file of some folders, without libFuzzer: PROGRAM TARGET FOLDER_OR_FILE...
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "fuzz/target.h"

namespace {

namespace fs = std::filesystem;
using namespace lodestone::fuzz;

/// The file, or the files of the folder by name.
std::vector<fs::path> files_of(const fs::path& given) {
  if (!fs::is_directory(given)) return {given};
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(given)) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

std::vector<std::uint8_t> bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(file.string() + ": cannot be read");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void run(const Target& target, const fs::path& file) {
  // Heap memory of exactly this size, so that a sanitizer sees a read past the end.
  const auto bytes = bytes_of(file);
  std::printf("%s\n", file.c_str());
  std::fflush(stdout);  // the last line tells the file that ends the process
  target.run(bytes);
}

}  // namespace

int main(int count, char** words) {
  const std::string name = count > 1 ? words[1] : "";
  const auto target = std::ranges::find_if(targets(), [&](const Target& t) { return name == t.name; });
  if (target == targets().end() || count < 3) {
    std::fprintf(stderr, "usage: PROGRAM TARGET FOLDER_OR_FILE...\ntargets:");
    for (const auto& known : targets()) std::fprintf(stderr, " %s", known.name);
    std::fprintf(stderr, "\n");
    return 2;
  }
  std::size_t files = 0;
  for (int word = 2; word < count; ++word)
    for (const auto& file : files_of(words[word])) run(*target, file), ++files;
  if (files == 0) fail("there is no input to run");
  std::printf("%s: %zu inputs\n", name.c_str(), files);
}
