// SPDX-License-Identifier: GPL-3.0-or-later
// Counts the heap allocations of a test program. Include it in one source file only.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

namespace lodestone {
inline std::size_t allocations = 0;
}

// Not inlined: the compiler would see memory from `new` go to `free`.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++lodestone::allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  ++lodestone::allocations;
  return std::malloc(size == 0 ? 1 : size);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
