// SPDX-License-Identifier: GPL-3.0-or-later
// Refuses what nlohmann-json silently accepts and a scene must not contain: duplicate keys, unlimited nesting.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include "io/files/json_reader.h"

namespace lodestone::detail {

namespace {

constexpr std::uintmax_t most_bytes = std::uintmax_t{16} << 20U;
constexpr std::size_t deepest = 128;

std::string read_text(const std::filesystem::path& file) {
  const auto fail = [&](std::string_view cause) { throw Bad_scene(fmt::format("{}: {}", file.string(), cause)); };
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) fail("there is no such file");
  // A pipe or a device could deliver bytes without end.
  if (!std::filesystem::is_regular_file(status)) fail("is not a regular file");
  if (std::filesystem::file_size(file, error) > most_bytes) fail("is longer than 16 MiB, too long for a scene");
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream) fail("cannot be read");
  return text;
}

/// `LINE:COLUMN` of a byte, both counted from 1.
std::string line_and_column(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, byte);
  const auto line = 1 + std::ranges::count(before, '\n');
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
  return fmt::format("{}:{}", line, before.size() - line_start + 1);
}

/// Parses the text without building a document, and stops at the first error.
class Syntax_check final : public nlohmann::json_sax<Json> {
 public:
  Syntax_check(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  bool null() override { return step(); }
  bool boolean(bool) override { return step(); }
  bool number_integer(number_integer_t) override { return step(); }
  bool number_unsigned(number_unsigned_t) override { return step(); }
  bool number_float(number_float_t, const string_t&) override { return step(); }
  bool string(string_t&) override { return step(); }
  bool binary(binary_t&) override { return step(); }
  bool start_object(std::size_t) override { return open(true); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(false); }
  bool end_array() override { return close(); }

  bool key(string_t& key) override {
    Level& level = levels_.back();
    if (!level.keys.insert(key).second)
      throw Bad_scene(fmt::format("{}: {}: duplicate key {}", name_, place(), as_json(key)));
    level.key = key;
    return true;
  }

  bool parse_error(std::size_t byte, const std::string&, const nlohmann::detail::exception& error) override {
    // Keeps only the cause of "[json.exception.parse_error.101] parse error at line 1, column 2: cause".
    std::string_view cause = error.what();
    for (const std::string_view lead : {"] ", "column "})
      if (const auto found = cause.find(lead); found != cause.npos) cause.remove_prefix(found + lead.size());
    cause.remove_prefix(std::min(cause.find_first_not_of("0123456789: "), cause.size()));
    constexpr std::size_t longest = 200;
    throw Bad_scene(
        fmt::format("{}:{}: {}", name_, line_and_column(text_, byte == 0 ? 0 : byte - 1), cause.substr(0, longest)));
  }

 private:
  /// An open object or array, and the progress within it.
  struct Level {
    bool is_object = false;
    std::set<std::string> keys;
    std::string key;
    std::size_t element = 0;
  };

  bool step() {
    if (!levels_.empty()) ++levels_.back().element;
    return true;
  }
  bool open(bool is_object) {
    if (levels_.size() == deepest)
      throw Bad_scene(fmt::format("{}: {}: is nested deeper than {} levels", name_, place(), deepest));
    levels_.push_back({.is_object = is_object, .keys = {}, .key = {}});
    return true;
  }
  bool close() {
    levels_.pop_back();
    return step();
  }

  /// JSON pointer to the innermost open object or array.
  std::string place() const {
    std::string result;
    for (std::size_t i = 0; i + 1 < levels_.size(); ++i) {
      const Level& level = levels_[i];
      const std::string quoted_key = as_json(level.key);
      result += "/" + (level.is_object ? quoted_key.substr(1, quoted_key.size() - 2) : std::to_string(level.element));
    }
    return result.empty() ? "/" : result;
  }

  std::string_view text_;
  std::string name_;
  std::vector<Level> levels_;
};

}  // namespace

Json parse_json(const std::filesystem::path& file) { return parse_json_text(read_text(file), file.string()); }

Json parse_json_text(std::string_view text, const std::string& name) {
  Syntax_check check(text, name);
  Json::sax_parse(text, &check);
  return Json::parse(text);
}

}  // namespace lodestone::detail
