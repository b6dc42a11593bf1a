// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace lodestone {

/// Leaves new elements as the memory was, unless they are given a value.
template <typename T>
struct Unset_allocator : std::allocator<T> {
  /// The same for elements of another type.
  template <typename U>
  struct rebind {                      // NOLINT(readability-identifier-naming): of the standard library
    using other = Unset_allocator<U>;  ///< the allocator
  };
  /// Makes an element without setting it.
  template <typename U>
  void construct(U* element) noexcept {
    static_assert(std::is_trivially_copyable_v<U>);
    ::new (static_cast<void*>(element)) U;
  }
  /// Makes an element from values.
  template <typename U, typename... Values>
  void construct(U* element, Values&&... values) {
    ::new (static_cast<void*>(element)) U(std::forward<Values>(values)...);
  }
};

/// A vector whose `resize(n)` does not set what it adds. For large lists that are written right away: setting them
/// first would be one more pass over memory.
template <typename T>
using Unset_vector = std::vector<T, Unset_allocator<T>>;

}  // namespace lodestone
