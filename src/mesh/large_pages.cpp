// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/large_pages.h"

#ifdef __linux__
#include <sys/mman.h>

#include <cstdint>
#endif

namespace lodestone {

#ifdef __linux__

void use_large_pages(const void* memory, std::size_t size) noexcept {
  const auto begin = reinterpret_cast<std::uintptr_t>(memory);
  const bool is_aligned = begin % large_page == 0;
  if (size < (is_aligned ? 1 : 2) * large_page) return;
  const std::uintptr_t first = (begin + large_page - 1) / large_page * large_page;
  const std::uintptr_t end = (begin + size) / large_page * large_page;
  madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
}

#else

void use_large_pages(const void*, std::size_t) noexcept {}

#endif

}  // namespace lodestone
