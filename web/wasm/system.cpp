// SPDX-License-Identifier: GPL-3.0-or-later
// What the library calls and Emscripten does not have.
#include <hwy/contrib/sort/vqsort.h>

#include <algorithm>

/// Boost's mapped files name it, for memory shared with other processes, of which there is none.
extern "C" int shmdt(const void* /*memory*/) { return -1; }

/// Highway's sort, which is compiled code elsewhere.
namespace hwy {

Sorter::Sorter() = default;
void Sorter::Delete() {}
void Sorter::operator()(std::uint32_t* keys, std::size_t n, SortAscending /*order*/) const {
  std::sort(keys, keys + n);
}
void Sorter::operator()(std::uint64_t* keys, std::size_t n, SortAscending /*order*/) const {
  std::sort(keys, keys + n);
}

}  // namespace hwy
