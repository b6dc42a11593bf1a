// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace lodestone {

/// Bytes of a large page, as x86 and 64-bit ARM have them.
constexpr std::size_t large_page = std::size_t{1} << 21;

/// Asks the system for large pages. Where memory is read here and there, each page has to be found first, and of large
/// ones there are few. Only advice, which a system may ignore: nothing else changes, and small lists are left alone.
/// @param memory  best not written so far
/// @param size    in bytes
void use_large_pages(const void* memory, std::size_t size) noexcept;

}  // namespace lodestone
