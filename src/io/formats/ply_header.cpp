// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace lodestone {
namespace {

struct Type_name {
  std::string_view name, sized_name;
  Ply_type type;
};

constexpr std::array<Type_name, 8> type_names = {{{"char", "int8", Ply_type::int8},
                                                  {"uchar", "uint8", Ply_type::uint8},
                                                  {"short", "int16", Ply_type::int16},
                                                  {"ushort", "uint16", Ply_type::uint16},
                                                  {"int", "int32", Ply_type::int32},
                                                  {"uint", "uint32", Ply_type::uint32},
                                                  {"float", "float32", Ply_type::float32},
                                                  {"double", "float64", Ply_type::float64}}};

Ply_type read_type(Text_scanner& text) {
  const auto word = text.next_word();
  for (const auto& [name, sized_name, type] : type_names)
    if (word == name || word == sized_name) return type;
  text.fail(fmt::format("expected a number type such as float or uint8, found {}", in_quotes(word)));
}

Ply_format read_format(Text_scanner& text) {
  const auto format = text.next_word(), version = text.next_word();
  if (version != "1.0") text.fail(fmt::format("expected PLY version 1.0, found {}", in_quotes(version)));
  if (format == "ascii") return Ply_format::ascii;
  if (format == "binary_little_endian") return Ply_format::binary_little_endian;
  if (format == "binary_big_endian") return Ply_format::binary_big_endian;
  text.fail(fmt::format("expected ascii, binary_little_endian or binary_big_endian, found {}", in_quotes(format)));
}

std::string read_name(Text_scanner& text) {
  const auto name = text.next_word();
  if (name.empty()) text.fail("the line ends before the name");
  return std::string(name);
}

Ply_element read_element(Text_scanner& text) {
  auto name = read_name(text);
  return {std::move(name), text.count(text.next_word()), {}};
}

Ply_property read_property(Text_scanner& text) {
  Ply_property property;
  auto rest_of_line = text;  // look-ahead: this word is either a type or `list`
  if (rest_of_line.next_word() == "list") {
    text.next_word();
    property.count_type = read_type(text);
    if (!is_integer(*property.count_type)) text.fail("the number of items of a list is no integer type");
  }
  property.type = read_type(text);
  property.name = read_name(text);
  return property;
}

void add_property(Text_scanner& text, Ply_header& header) {
  if (header.elements.empty()) text.fail("a property stands before the first element");
  auto& properties = header.elements.back().properties;
  auto property = read_property(text);
  if (std::ranges::count(properties, property.name, &Ply_property::name) != 0)
    text.fail(fmt::format("duplicate property {} in one element", in_quotes(property.name)));
  properties.push_back(std::move(property));
}

/// Moves to the next line that is not a comment and reads its first word.
std::string_view next_keyword(Text_scanner& text) {
  while (text.next_line()) {
    const auto keyword = text.next_word();
    if (keyword != "comment" && keyword != "obj_info") return keyword;
  }
  text.fail("the file ends within the header");
}

void need_keyword(Text_scanner& text, std::string_view expected) {
  const auto keyword = next_keyword(text);
  if (keyword != expected) text.fail(fmt::format("expected '{}', found {}", expected, in_quotes(keyword)));
}

}  // namespace

std::size_t bytes_of(Ply_type type) {
  switch (type) {
    case Ply_type::int8:
    case Ply_type::uint8:
      return 1;
    case Ply_type::int16:
    case Ply_type::uint16:
      return 2;
    case Ply_type::float64:
      return 8;
    default:
      return 4;
  }
}

bool is_integer(Ply_type type) { return type != Ply_type::float32 && type != Ply_type::float64; }

Ply_header read_ply_header(Text_scanner& text) {
  Ply_header header;
  need_keyword(text, "ply");
  need_keyword(text, "format");
  header.format = read_format(text);
  for (auto keyword = next_keyword(text); keyword != "end_header"; keyword = next_keyword(text)) {
    if (keyword == "element")
      header.elements.push_back(read_element(text));
    else if (keyword == "property")
      add_property(text, header);
    else
      text.fail(fmt::format("expected element, property or end_header, found {}", in_quotes(keyword)));
  }
  text.skip_rest_of_line();
  return header;
}

}  // namespace lodestone
