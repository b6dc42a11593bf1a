// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

/// How objects are turned into bytes and back: numbers and lists one after the other, as they lie in memory.
namespace lodestone {

/// What is written as it lies in memory: no pointers, and no padding, whose bytes could be any.
template <class T>
concept Savable = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T> &&
                  (std::floating_point<T> || std::has_unique_object_representations_v<T>);

/// Turns numbers and lists into bytes, one after the other.
class State_writer {
 public:
  /// One number, or a struct of numbers without padding.
  template <Savable T>
  void value(const T& value) {
    bytes(std::as_bytes(std::span(&value, 1)));
  }
  /// How many, then all of them.
  template <Savable T>
  void list(std::span<const T> values) {
    value(std::uint64_t{values.size()});
    bytes(std::as_bytes(values));
  }
  /// The same for a vector.
  template <Savable T, typename Allocator>
  void list(const std::vector<T, Allocator>& values) {
    list(std::span<const T>(values));
  }

  /// All that was written; the writer is empty afterwards.
  std::vector<std::byte> take() { return std::exchange(bytes_, {}); }

 private:
  void bytes(std::span<const std::byte> added) { bytes_.insert(bytes_.end(), added.begin(), added.end()); }

  std::vector<std::byte> bytes_;
};

/// Reads what a State_writer has written. Believes nothing: a list is never longer than what is left of the bytes.
class State_reader {
 public:
  /// @param bytes  must outlive this
  explicit State_reader(std::span<const std::byte> bytes) : left_(bytes) {}

  /// The next number, or struct of numbers.
  /// @throws Bad_saved_object  the bytes end too early
  template <Savable T>
  T value() {
    T value;
    std::memcpy(&value, next(1, sizeof(T)).data(), sizeof(T));
    return value;
  }
  /// A number that is neither infinite nor NaN.
  /// @throws Bad_saved_object  it is; the bytes end too early
  double finite() {
    const auto number = value<double>();
    require(std::isfinite(number), "a number is not finite");
    return number;
  }
  /// The next list.
  /// @throws Bad_saved_object  the bytes end too early
  template <Savable T>
  std::vector<T> list() {
    std::vector<T> values;
    list(values);
    return values;
  }
  /// The next list, written to a vector of any allocator.
  /// @throws Bad_saved_object  the bytes end too early
  template <Savable T, typename Allocator>
  void list(std::vector<T, Allocator>& values) {
    const auto count = value<std::uint64_t>();
    const auto bytes = next(count, sizeof(T));
    values.resize(count);
    if (count > 0) std::memcpy(values.data(), bytes.data(), bytes.size());
  }
  /// Checks that all has been read.
  /// @throws Bad_saved_object  there are more bytes
  void end() const;

  /// Refuses the bytes.
  /// @throws Bad_saved_object, always
  [[noreturn]] static void fail(std::string_view cause);
  /// Refuses the bytes unless they are right.
  /// @throws Bad_saved_object  `right` is false
  static void require(bool right, std::string_view cause) {
    if (!right) fail(cause);
  }

 private:
  std::span<const std::byte> next(std::uint64_t count, std::size_t size);

  std::span<const std::byte> left_;
};

/// 64 bits that almost surely differ if the bytes do: XXH3. The same on every machine with the same byte order.
std::uint64_t hash_of(std::span<const std::byte> bytes);

}  // namespace lodestone
