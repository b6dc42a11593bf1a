// SPDX-License-Identifier: GPL-3.0-or-later
// Replaces operator new and delete of the program and of all libraries, and malloc of the program and of what is linked
// statically, such as Lodestone and Eigen. GMP keeps its own: it ends the program when it gets no memory.
#include "memory/failing_memory.h"

#include <atomic>
#include <cstdlib>
#include <new>

extern "C" {
void* __real_malloc(std::size_t size);
void* __real_calloc(std::size_t count, std::size_t size);
void* __real_realloc(void* memory, std::size_t size);
void __real_free(void* memory);
void* __wrap_malloc(std::size_t size);
void* __wrap_calloc(std::size_t count, std::size_t size);
void* __wrap_realloc(void* memory, std::size_t size);
void __wrap_free(void* memory);
}

namespace lodestone::test {
namespace {

std::atomic<std::size_t> made = 0, failing = never;
std::atomic<bool> failed = false;
std::atomic<std::ptrdiff_t> live = 0;
std::atomic<std::size_t> largest = 0;

void note_size(std::size_t size) {
  for (std::size_t seen = largest; seen < size && !largest.compare_exchange_weak(seen, size);) {
  }
}

/// Whether the allocation that begins now may succeed.
bool may_succeed() {
  if (made++ != failing) return true;
  failed = true;
  return false;
}

void* counted(void* memory) {
  if (memory != nullptr) ++live;
  return memory;
}

void freed(const void* memory) {
  if (memory != nullptr) --live;
}

void* allocate(std::size_t size) { return may_succeed() ? counted(__real_malloc(size == 0 ? 1 : size)) : nullptr; }

void* allocate_aligned(std::size_t size, std::align_val_t alignment) {
  const auto unit = static_cast<std::size_t>(alignment);
  return may_succeed() ? counted(std::aligned_alloc(unit, (size + unit) / unit * unit)) : nullptr;
}

void* or_throw(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void release(void* memory) {
  freed(memory);
  __real_free(memory);
}

}  // namespace

void fail_allocation(std::size_t number) {
  failing = never;
  made = 0;
  failed = false;
  largest = 0;
  failing = number;
}
std::size_t allocations() { return made; }
bool allocation_failed() { return failed; }
std::ptrdiff_t live_blocks() { return live; }
std::size_t largest_block() { return largest; }

}  // namespace lodestone::test

using namespace lodestone::test;

void* __wrap_malloc(std::size_t size) { return allocate(size); }
void* __wrap_calloc(std::size_t count, std::size_t size) {
  return may_succeed() ? counted(__real_calloc(count, size)) : nullptr;
}
void* __wrap_realloc(void* memory, std::size_t size) {
  if (!may_succeed()) return nullptr;
  void* const result = __real_realloc(memory, size);
  if (memory == nullptr) counted(result);
  return result;
}
void __wrap_free(void* memory) { release(memory); }

// Not inlined: the compiler would see memory from `new` go to `free`.
[[gnu::noinline]] void* operator new(std::size_t size) {
  note_size(size);
  return or_throw(allocate(size));
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return allocate(size); }
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  return or_throw(allocate_aligned(size, alignment));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { release(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { release(memory); }
[[gnu::noinline]] void operator delete(void* memory, const std::nothrow_t&) noexcept { release(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }
