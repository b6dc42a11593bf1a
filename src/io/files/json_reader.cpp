// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/json_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "io/files/small_text.h"

namespace lodestone::detail {

std::string as_json(std::string_view text) {
  constexpr std::size_t longest = 80;
  const bool cut = text.size() > longest;
  // Truncation can split a character: `replace` substitutes the remainder.
  const Json shown = cut ? std::string(text.substr(0, longest)) + "..." : std::string(text);
  return shown.dump(-1, ' ', true, Json::error_handler_t::replace);
}

std::string valid_utf8(std::string_view text) {
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

std::string quoted_name(std::string_view name) {
  constexpr std::size_t longest = 200;
  // Truncation can split a character: `valid_utf8` substitutes the remainder.
  const auto shown = valid_utf8(printable(std::string(name.substr(0, longest))));
  return "'" + shown + (name.size() > longest ? "...'" : "'");
}

Json_value::Json_value(const Json& value, std::string file, std::string place)
    : value_(&value), file_(std::move(file)), place_(std::move(place)) {}

std::string Json_value::at_place(std::string_view cause) const {
  return fmt::format("{}: {}: {}", file_, place_.empty() ? "/" : place_, cause);
}

void Json_value::fail(std::string_view cause) const { throw Bad_scene(at_place(cause)); }

void Json_value::wrong_type(std::string_view expected) const {
  fail(fmt::format("expected {}, found {}", expected, value_->type_name()));
}

Json_value Json_value::child(const Json& value, const std::string& key) const {
  return {value, file_, place_ + "/" + key};
}

// ---- Objects ----

void Json_value::expect_object() const {
  if (!value_->is_object()) wrong_type("an object");
}

void Json_value::expect_keys(std::initializer_list<std::string_view> keys) const {
  expect_object();
  for (const auto& entry : value_->items())
    if (std::ranges::find(keys, entry.key()) == keys.end())
      fail(fmt::format("unknown key {} (expected one of {})", as_json(entry.key()), fmt::join(keys, ", ")));
}

std::string Json_value::exactly_one_of(std::initializer_list<std::string_view> keys) const {
  std::vector<std::string_view> found;
  std::ranges::copy_if(keys, std::back_inserter(found), [&](std::string_view key) { return has(key); });
  if (found.size() == 1) return std::string(found.front());
  if (found.empty()) fail(fmt::format("missing key: one of {}", fmt::join(keys, ", ")));
  fail(fmt::format("{} exclude each other", fmt::join(found, " and ")));
}

std::string Json_value::expect_one_key(std::initializer_list<std::string_view> keys) const {
  expect_keys(keys);
  return exactly_one_of(keys);
}

bool Json_value::has(std::string_view key) const { return value_->contains(key); }

Json_value Json_value::at(std::string_view key) const {
  if (auto value = find(key)) return *value;
  fail(fmt::format("missing key {}", as_json(key)));
}

std::optional<Json_value> Json_value::find(std::string_view key) const {
  const auto entry = value_->find(key);
  if (entry == value_->end()) return std::nullopt;
  return child(*entry, std::string(key));
}

// ---- Arrays ----

std::vector<Json_value> Json_value::elements(std::size_t most) const {
  if (!value_->is_array()) wrong_type("an array");
  if (value_->empty()) fail("is empty");
  if (value_->size() > most) fail(fmt::format("has {} elements, at most {} are allowed", value_->size(), most));
  std::vector<Json_value> result;
  for (std::size_t i = 0; i < value_->size(); ++i) result.push_back(child((*value_)[i], std::to_string(i)));
  return result;
}

std::vector<Json_value> Json_value::list(std::string_view key, std::size_t most) const {
  const auto value = find(key);
  if (!value || (value->is_array() && value->value_->empty())) return {};
  return value->elements(most);
}

Kernel::Vector_3 Json_value::vector() const {
  if (!value_->is_array()) wrong_type("an array of 3 numbers");
  if (value_->size() != 3) fail(fmt::format("expected 3 numbers, found {}", value_->size()));
  const auto components = elements(3);
  return {components[0].number(), components[1].number(), components[2].number()};
}

// ---- Single values ----

std::string Json_value::text() const {
  if (!value_->is_string()) wrong_type("a string");
  auto text = value_->get<std::string>();
  if (text.empty()) fail("is empty");
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; };
  if (std::ranges::any_of(text, is_control)) fail(fmt::format("{} has a control character", as_json(text)));
  return text;
}

std::string Json_value::any_text() const {
  if (!value_->is_string()) wrong_type("a string");
  return value_->get<std::string>();
}

bool Json_value::boolean() const {
  if (!value_->is_boolean()) wrong_type("true or false");
  return value_->get<bool>();
}

std::string Json_value::word(std::initializer_list<std::string_view> words) const {
  std::string result = text();
  if (std::ranges::find(words, result) == words.end())
    fail(fmt::format("{} is not one of {}", as_json(result), fmt::join(words, ", ")));
  return result;
}

double Json_value::number() const {
  if (!value_->is_number()) wrong_type("a number");
  return value_->get<double>();
}

std::size_t Json_value::count(std::size_t least, std::size_t most) const {
  const double value = number();
  if (value != std::floor(value) || value < double(least) || value > double(most))
    fail(fmt::format("{} is not a whole number from {} to {}", value, least, most));
  return static_cast<std::size_t>(value);
}

double Json_value::number(std::string_view key, double otherwise) const {
  const auto value = find(key);
  return value ? value->number() : otherwise;
}

std::size_t Json_value::count(std::string_view key, std::size_t least, std::size_t most, std::size_t otherwise) const {
  const auto value = find(key);
  return value ? value->count(least, most) : otherwise;
}

Kernel::Vector_3 Json_value::vector(std::string_view key, const Kernel::Vector_3& otherwise) const {
  const auto value = find(key);
  return value ? value->vector() : otherwise;
}

}  // namespace lodestone::detail
