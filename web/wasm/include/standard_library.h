// SPDX-License-Identifier: GPL-3.0-or-later
// What the standard library of Emscripten lacks of C++20, from range-v3 where it has it. Included before every source.
#pragma once

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <memory>
#include <range/v3/algorithm.hpp>
#include <string>
#include <system_error>
#include <type_traits>

namespace std {

namespace ranges {
using ::ranges::adjacent_find;
using ::ranges::all_of;
using ::ranges::any_of;
using ::ranges::binary_search;
using ::ranges::copy;
using ::ranges::copy_if;
using ::ranges::count;
using ::ranges::count_if;
using ::ranges::equal;
using ::ranges::equal_range;
using ::ranges::fill;
using ::ranges::find;
using ::ranges::find_if;
using ::ranges::find_if_not;
using ::ranges::includes;
using ::ranges::is_sorted;
using ::ranges::lower_bound;
using ::ranges::make_heap;
using ::ranges::max;
using ::ranges::max_element;
using ::ranges::min_element;
using ::ranges::minmax;
using ::ranges::mismatch;
using ::ranges::none_of;
using ::ranges::nth_element;
using ::ranges::partial_sort;
using ::ranges::pop_heap;
using ::ranges::push_heap;
using ::ranges::replace;
using ::ranges::replace_if;
using ::ranges::reverse;
using ::ranges::set_difference;
using ::ranges::sort;
using ::ranges::stable_partition;
using ::ranges::stable_sort;
using ::ranges::transform;
using ::ranges::unique;
using ::ranges::upper_bound;
}  // namespace ranges

template <class T>
unique_ptr<T> make_unique_for_overwrite(size_t size) {
  return unique_ptr<T>(new remove_extent_t<T>[size]);
}
template <class T>
unique_ptr<T> make_unique_for_overwrite() {
  return unique_ptr<T>(new T);
}

/// By strtod, which also takes blanks, a plus sign and hexadecimal numbers.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  const char* digits = first != last && *first == '-' ? first + 1 : first;
  const bool is_number =
      digits != last && *digits != '+' && *digits != '-' && !isspace(static_cast<unsigned char>(*digits));
  const bool is_hexadecimal = last - digits > 1 && digits[0] == '0' && (digits[1] == 'x' || digits[1] == 'X');
  if (!is_number) return {first, errc::invalid_argument};
  if (is_hexadecimal) {
    value = *first == '-' ? -0.0 : 0.0;
    return {digits + 1, errc()};
  }
  const string text(first, last);
  char* end = nullptr;
  const double read = strtod(text.c_str(), &end);
  if (end == text.c_str()) return {first, errc::invalid_argument};
  const char* after = first + (end - text.c_str());
  if (read == numeric_limits<double>::infinity() || read == -numeric_limits<double>::infinity())
    if (*digits != 'i' && *digits != 'I') return {after, errc::result_out_of_range};
  value = read;
  return {after, errc()};
}

template <class To, class From>
constexpr To bit_cast(const From& from) {
  return __builtin_bit_cast(To, from);
}

}  // namespace std
