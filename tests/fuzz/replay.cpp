// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a fuzz target without libFuzzer. On every file of some folders: PROGRAM TARGET FOLDER_OR_FILE... On inputs of
// random bytes, which finds less than libFuzzer, but in a fast build tries many more: PROGRAM TARGET --random COUNT
// SEED.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

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

std::vector<std::uint8_t> current;

/// Prints the input that has ended the process, to be made a file by `xxd -r -p`.
void print_current(int /*signal*/) {
  for (const auto byte : current) std::fprintf(stderr, "%02x", byte);
  std::fprintf(stderr, "\n");
}

/// All inputs are drawn from one sequence, so that those of two seeds have nothing in common.
void run_random(const Target& target, std::uint64_t inputs, std::uint64_t seed) {
  constexpr std::size_t longest = 80;
  std::signal(SIGABRT, print_current);
  std::mt19937_64 random(seed);
  for (std::uint64_t input = 0; input < inputs; ++input) {
    current.resize(random() % longest);
    for (auto& byte : current) byte = static_cast<std::uint8_t>(random());
    target.run(current);
  }
  std::printf("%s: %llu random inputs\n", target.name, static_cast<unsigned long long>(inputs));
}

std::size_t run_files(const Target& target, std::span<char*> given) {
  std::size_t files = 0;
  for (const char* word : given)
    for (const auto& file : files_of(word)) run(target, file), ++files;
  return files;
}

}  // namespace

int main(int count, char** words) {
  const std::string name = count > 1 ? words[1] : "";
  const auto target = std::ranges::find_if(targets(), [&](const Target& t) { return name == t.name; });
  if (target == targets().end() || count < 3) {
    std::fprintf(stderr, "usage: PROGRAM TARGET FOLDER_OR_FILE... | PROGRAM TARGET --random COUNT SEED\ntargets:");
    for (const auto& known : targets()) std::fprintf(stderr, " %s", known.name);
    std::fprintf(stderr, "\n");
    return 2;
  }
  if (count == 5 && std::string(words[2]) == "--random") {
    run_random(*target, std::strtoull(words[3], nullptr, 10), std::strtoull(words[4], nullptr, 10));
    return 0;
  }
  const auto files = run_files(*target, {words + 2, static_cast<std::size_t>(count - 2)});
  if (files == 0) fail("there is no input to run");
  std::printf("%s: %zu inputs\n", name.c_str(), files);
}
