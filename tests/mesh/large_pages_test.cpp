// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/large_pages.h"

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>

namespace lodestone {

namespace {

constexpr std::size_t megabyte = std::size_t{1} << 20;

/// Memory that nobody has written, of no heap: its parts may have been advised for others.
struct Memory {
  explicit Memory(std::size_t length)
      : bytes(static_cast<char*>(::mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0))),
        size(length) {}
  Memory(const Memory&) = delete;
  ~Memory() { ::munmap(bytes, size); }

  char* bytes;
  std::size_t size;
};

/// Whether the system was asked for large pages where a byte lies: the flag `hg` of its mapping. None: it does not say.
std::optional<bool> is_advised(const char* byte) {
  const auto address = reinterpret_cast<std::uintptr_t>(byte);
  std::ifstream mappings("/proc/self/smaps");
  bool is_here = false;
  for (std::string line; std::getline(mappings, line);) {
    std::uintptr_t begin = 0, end = 0;
    char dash = 0;
    std::istringstream words(line);
    if (words >> std::hex >> begin >> dash >> end && dash == '-')
      is_here = begin <= address && address < end;
    else if (is_here && line.starts_with("VmFlags:"))
      return line.find(" hg") != std::string::npos;
  }
  return std::nullopt;
}

TEST(Large_pages, are_asked_for_in_the_middle_of_large_memory_only) {
  const Memory large(64 * megabyte), small(3 * megabyte);
  if (!std::filesystem::exists("/sys/kernel/mm/transparent_hugepage/enabled") || !is_advised(large.bytes))
    GTEST_SKIP() << "no large pages here";
  use_large_pages(large.bytes, large.size);
  use_large_pages(small.bytes, small.size);
  EXPECT_TRUE(is_advised(large.bytes + large.size / 2).value());
  EXPECT_FALSE(is_advised(small.bytes + small.size / 2).value());
}

TEST(Large_pages, leave_what_the_memory_holds) {
  const Memory memory(16 * megabyte);
  for (std::size_t i = 0; i < memory.size; i += 1000) memory.bytes[i] = static_cast<char>(i % 101);
  use_large_pages(memory.bytes + 13, memory.size - 13);
  for (std::size_t i = 0; i < memory.size; i += 1000) ASSERT_EQ(memory.bytes[i], static_cast<char>(i % 101));
}

TEST(Large_pages, may_be_asked_for_no_memory) { use_large_pages(nullptr, 0); }

}  // namespace

}  // namespace lodestone
