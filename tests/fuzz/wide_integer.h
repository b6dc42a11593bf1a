// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace lodestone::fuzz {

/// An integer of 256 bits, enough for determinants of coordinates of 80 bits. Faster than numbers of any size, since it
/// allocates nothing. Two's complement.
class Wide_integer {
 public:
  Wide_integer() = default;
  Wide_integer(std::int64_t value) {  // NOLINT: numbers convert
    words_.fill(value < 0 ? ~std::uint64_t{0} : 0);
    words_[0] = static_cast<std::uint64_t>(value);
  }

  /// Times a power of two.
  Wide_integer shifted(std::size_t bits) const {
    Wide_integer result;
    const std::size_t words = bits / 64, rest = bits % 64;
    for (std::size_t i = words; i < size; ++i) {
      result.words_[i] = words_[i - words] << rest;
      if (rest > 0 && i > words) result.words_[i] |= words_[i - words - 1] >> (64 - rest);
    }
    return result;
  }

  friend Wide_integer operator+(const Wide_integer& a, const Wide_integer& b) {
    Wide_integer sum;
    Double_word carry = 0;
    for (std::size_t i = 0; i < size; ++i) {
      carry += Double_word{a.words_[i]} + b.words_[i];
      sum.words_[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64U;
    }
    return sum;
  }
  friend Wide_integer operator-(const Wide_integer& a, const Wide_integer& b) {
    Wide_integer inverse;
    for (std::size_t i = 0; i < size; ++i) inverse.words_[i] = ~b.words_[i];
    return a + inverse + Wide_integer(1);
  }
  friend Wide_integer operator*(const Wide_integer& a, const Wide_integer& b) {
    Wide_integer product;
    for (std::size_t i = 0; i < size; ++i) {
      Double_word carry = 0;
      for (std::size_t j = 0; i + j < size; ++j) {
        carry += Double_word{a.words_[i]} * b.words_[j] + product.words_[i + j];
        product.words_[i + j] = static_cast<std::uint64_t>(carry);
        carry >>= 64U;
      }
    }
    return product;
  }
  friend bool operator==(const Wide_integer&, const Wide_integer&) = default;
  friend bool operator<(const Wide_integer& a, const Wide_integer& b) { return (a - b).is_negative(); }
  friend bool operator>(const Wide_integer& a, const Wide_integer& b) { return b < a; }

 private:
  using Double_word = unsigned __int128;
  static constexpr std::size_t size = 4;

  bool is_negative() const { return words_[size - 1] >> 63U != 0; }

  std::array<std::uint64_t, size> words_{};  ///< the lowest first
};

}  // namespace lodestone::fuzz
