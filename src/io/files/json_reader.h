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

/// Checked reading of JSON: every question a reader asks is answered, or ends in a Bad_scene that names file and place.
namespace lodestone::detail {

using Json = nlohmann::json;

/// The file as JSON.
/// @throws Bad_scene  no such file, more than 16 MiB, a syntax error (with line and column), a key that stands twice in
/// one
///                    object, nesting deeper than 32
Json parse_json(const std::filesystem::path& file);

/// The same for a text in memory of any length.
/// @param name  of the file it is from, for messages
Json parse_json_text(std::string_view text, const std::string& name);

/// `text` as a JSON string: in double quotes, on one line whatever it holds, cut after 80 characters.
std::string in_quotes(std::string_view text);

/// A value of a document and where it stands. The document must outlive it.
class Json_value {
 public:
  /// @param file   the document's name, for messages
  /// @param place  JSON pointer to `value`
  Json_value(const Json& value, std::string file, std::string place = {});

  /// @throws Bad_scene, always: `FILE: PLACE: cause`
  [[noreturn]] void fail(std::string_view cause) const;

  /// Refuses anything but an object.
  void expect_object() const;
  /// Refuses anything but an object, and one with keys other than these.
  void expect_keys(std::initializer_list<std::string_view> keys) const;
  /// The only key of an object, which must be one of these.
  std::string expect_one_key(std::initializer_list<std::string_view> keys) const;
  /// The key that is there, of several that exclude each other.
  std::string exactly_one_of(std::initializer_list<std::string_view> keys) const;

  bool has(std::string_view key) const;
  /// Refuses an object without the key.
  Json_value at(std::string_view key) const;
  std::optional<Json_value> find(std::string_view key) const;

  /// Refuses an empty array and one of more than `most` elements.
  std::vector<Json_value> elements(std::size_t most) const;
  /// The elements under a key of an object; none where the key is missing or its array empty.
  std::vector<Json_value> list(std::string_view key, std::size_t most) const;
  bool is_string() const { return value_->is_string(); }
  bool is_array() const { return value_->is_array(); }

  /// Refuses an empty string and control characters, which would break messages, tables and file names.
  std::string text() const;
  /// A string that may hold anything.
  std::string any_text() const;
  bool boolean() const;
  /// One of several words.
  std::string word(std::initializer_list<std::string_view> words) const;
  double number() const;
  /// A whole number of [least, most].
  std::size_t count(std::size_t least, std::size_t most) const;
  /// Three numbers.
  Kernel::Vector_3 vector() const;

  // The same for a key of an object, with a value to use when it is not there.
  double number(std::string_view key, double otherwise) const;
  std::size_t count(std::string_view key, std::size_t least, std::size_t most, std::size_t otherwise) const;
  Kernel::Vector_3 vector(std::string_view key, const Kernel::Vector_3& otherwise) const;

  /// What `build` returns; a Bad_argument it throws becomes an error of this place.
  template <class Build>
  auto checked(Build build) const {
    try {
      return build();
    } catch (const Bad_argument& error) {
      fail(error.what());
    }
  }

 private:
  Json_value child(const Json& value, const std::string& key) const;
  [[noreturn]] void wrong_type(std::string_view expected) const;

  const Json* value_;
  std::string file_;
  std::string place_;
};

}  // namespace lodestone::detail
