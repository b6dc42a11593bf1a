// SPDX-License-Identifier: GPL-3.0-or-later
// Coordinates that end at the end of readable memory.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <new>
#include <span>

namespace lodestone {

/// A copy of some coordinates. Reading past the last one crashes the program.
class Guarded_coordinates {
 public:
  explicit Guarded_coordinates(std::span<const double> values) {
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const std::size_t readable = (values.size_bytes() + page - 1) / page * page;
    size_ = readable + page;
    memory_ = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory_ == MAP_FAILED) throw std::bad_alloc();
    char* const end = static_cast<char*>(memory_) + readable;
    if (mprotect(end, page, PROT_NONE) != 0) throw std::bad_alloc();
    values_ = std::span(reinterpret_cast<double*>(end) - values.size(), values.size());
    std::ranges::copy(values, values_.begin());
  }
  ~Guarded_coordinates() { munmap(memory_, size_); }
  Guarded_coordinates(const Guarded_coordinates&) = delete;
  Guarded_coordinates& operator=(const Guarded_coordinates&) = delete;

  std::span<const double> values() const { return values_; }

 private:
  void* memory_ = nullptr;
  std::size_t size_ = 0;
  std::span<double> values_;
};

}  // namespace lodestone
