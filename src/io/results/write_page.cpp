// SPDX-License-Identifier: GPL-3.0-or-later
// A page as a file: title and data inside the viewer's template.
#include <algorithm>
#include <string>

#include "lodestone/io/results/page.h"
#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

constexpr std::string_view title_place = "@LODESTONE_TITLE@", data_place = "@LODESTONE_DATA@";

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : text) switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\'':
        html += "&#39;";
        break;
      default:
        html += c;
    }
  return html;
}

/// @param bytes  a multiple of three bytes, except in the last call
std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (; !bytes.empty(); bytes.remove_prefix(std::min<std::size_t>(3, bytes.size()))) {
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < 3; ++i)
      group = group << 8 | (i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U);
    for (std::size_t i = 0; i < 4; ++i) text += i <= bytes.size() ? digits[group >> (18 - 6 * i) & 63] : '=';
  }
  return text;
}

/// Counts the bytes that it writes.
struct Counted_file {
  Atomic_file& file;
  std::size_t bytes = 0;

  void write(std::string_view text) {
    file.write(text);
    bytes += text.size();
  }
};

void write_base64(Counted_file& file, std::string_view bytes) {
  constexpr std::size_t piece = 3 << 16;
  for (; !bytes.empty(); bytes.remove_prefix(std::min(piece, bytes.size()))) file.write(base64(bytes.substr(0, piece)));
}

void write_titled(Counted_file& file, std::string_view text, std::string_view title) {
  for (auto at = text.find(title_place); at != std::string_view::npos; at = text.find(title_place)) {
    file.write(text.substr(0, at));
    file.write(title);
    text.remove_prefix(at + title_place.size());
  }
  file.write(text);
}

}  // namespace

std::size_t write_page(Atomic_file& file, std::string_view page_template, std::string_view title,
                       std::string_view data) {
  const auto at = page_template.find(data_place);
  if (at == std::string_view::npos || page_template.find(data_place, at + 1) != std::string_view::npos)
    throw Bad_argument("the template of a page must have @LODESTONE_DATA@ exactly once");
  const std::string shown = escaped(title);
  Counted_file counted{file};
  write_titled(counted, page_template.substr(0, at), shown);
  write_base64(counted, data);
  write_titled(counted, page_template.substr(at + data_place.size()), shown);
  return counted.bytes;
}

}  // namespace lodestone
