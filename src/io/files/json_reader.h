// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lodestone/mesh/concepts.h"
#include "lodestone/mesh/errors.h"

/// Checked reading of JSON: every access returns a valid value or throws a Bad_scene with file, JSON pointer and cause.
namespace lodestone::detail {

using Json = nlohmann::json;

/// The file as JSON.
/// @throws Bad_scene  no such file, more than 16 MiB, a syntax error (with line and column), a duplicate key in an
///                    object, nesting deeper than 128 levels
Json parse_json(const std::filesystem::path& file);

/// The same for a text in memory, of any length.
/// @param name  file name for messages
Json parse_json_text(std::string_view text, const std::string& name);

/// `text` as a JSON string: in double quotes, always on one line, truncated to 80 characters.
std::string as_json(std::string_view text);

/// `text` with U+FFFD for whatever is no UTF-8, so that it is written to JSON as it is.
std::string valid_utf8(std::string_view text);

/// A name that a file gives, in quotes, for a one-line message: control characters as `?`, truncated to 200 bytes.
std::string quoted_name(std::string_view name);

/// A value of a document, with its JSON pointer. The document must outlive it.
class Json_value {
 public:
  /// @param file   name of the document, for messages
  /// @param place  JSON pointer to `value`
  Json_value(const Json& value, std::string file, std::string place = {});

  /// @throws Bad_scene  always: `FILE: POINTER: cause`
  [[noreturn]] void fail(std::string_view cause) const;

  /// Refuses anything but an object.
  void expect_object() const;
  /// Refuses anything but an object, and any key other than these.
  void expect_keys(std::initializer_list<std::string_view> keys) const;
  /// The key of an object that has exactly one key, out of these.
  std::string expect_one_key(std::initializer_list<std::string_view> keys) const;
  /// Which one of several mutually exclusive keys the object has.
  std::string exactly_one_of(std::initializer_list<std::string_view> keys) const;

  bool has(std::string_view key) const;
  /// The value under a key. Refuses an object without the key.
  Json_value at(std::string_view key) const;
  std::optional<Json_value> find(std::string_view key) const;

  /// The elements of an array. Refuses an empty array and one with more than `most` elements.
  std::vector<Json_value> elements(std::size_t most) const;
  /// The elements of the array under a key of an object; none if the key is missing or the array empty.
  std::vector<Json_value> list(std::string_view key, std::size_t most) const;
  bool is_string() const { return value_->is_string(); }
  bool is_array() const { return value_->is_array(); }

  /// A string. Refuses an empty one and control characters, which would break messages, tables and file names.
  std::string text() const;
  /// A string with any contents.
  std::string any_text() const;
  bool boolean() const;
  /// A string that is one of `words`.
  std::string word(std::initializer_list<std::string_view> words) const;
  double number() const;
  /// An integer in [least, most].
  std::size_t count(std::size_t least, std::size_t most) const;
  /// Three numbers.
  Kernel::Vector_3 vector() const;

  // The same for a key of an object, with a default for a missing key.
  double number(std::string_view key, double otherwise) const;
  std::size_t count(std::string_view key, std::size_t least, std::size_t most, std::size_t otherwise) const;
  Kernel::Vector_3 vector(std::string_view key, const Kernel::Vector_3& otherwise) const;

  /// What `read` returns, which reads files that the value names. An error about them is thrown with the place of the
  /// value before it: `FILE: POINTER: cause`.
  template <class Read>
  auto from_files(Read read) const {
    try {
      return read();
    } catch (const Bad_mesh& error) {
      throw Bad_mesh(at_place(error.what()));
    } catch (const Bad_motion& error) {
      throw Bad_motion(at_place(error.what()));
    }
  }

  /// What `build` returns. A Bad_argument that it throws is reported as a Bad_scene of this value.
  template <class Build>
  auto checked(Build build) const {
    try {
      return build();
    } catch (const Bad_argument& error) {
      fail(error.what());
    }
  }

 private:
  /// `FILE: POINTER: cause`.
  std::string at_place(std::string_view cause) const;
  Json_value child(const Json& value, const std::string& key) const;
  [[noreturn]] void wrong_type(std::string_view expected) const;

  const Json* value_;
  std::string file_;
  std::string place_;
};

}  // namespace lodestone::detail
