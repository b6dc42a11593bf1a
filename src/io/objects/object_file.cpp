// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/objects/object_file.h"

#include <cstdint>

#include "io/files/file_bytes.h"
#include "lodestone/io/files/atomic_file.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

constexpr std::uintmax_t longest_file = std::uintmax_t{16} << 30U;

File_bytes open(const std::filesystem::path& file) {
  try {
    return {file, longest_file};
  } catch (const Bad_mesh& error) {
    throw Bad_saved_object(error.what());
  }
}

}  // namespace

void write_object_file(std::span<const std::byte> saved, const std::filesystem::path& file) {
  write_whole(file, {reinterpret_cast<const char*>(saved.data()), saved.size()});
}

void read_object_file(const std::filesystem::path& file, const std::function<void(std::span<const std::byte>)>& load) {
  const File_bytes bytes = open(file);
  try {
    load(std::as_bytes(std::span(bytes.view())));
  } catch (const Bad_saved_object& error) {
    throw Bad_saved_object(bytes.name() + ": " + error.what());
  }
}

}  // namespace lodestone
