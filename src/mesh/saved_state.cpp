// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/saved_state.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <string>

#include "lodestone/mesh/errors.h"

namespace lodestone {

void State_reader::fail(std::string_view cause) {
  throw Bad_saved_object("the saved object is broken: " + std::string(cause));
}

void State_reader::end() const { require(left_.empty(), "there are more bytes than it has"); }

std::span<const std::byte> State_reader::next(std::uint64_t count, std::size_t size) {
  require(count <= left_.size() / size, "it ends too early");
  const auto bytes = left_.first(count * size);
  left_ = left_.subspan(bytes.size());
  return bytes;
}

std::uint64_t hash_of(std::span<const std::byte> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

}  // namespace lodestone
