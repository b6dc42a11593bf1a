// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/results/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

bool is_number(const std::string& cell) {
  return !cell.empty() && (std::isdigit(static_cast<unsigned char>(cell[0])) != 0 || cell[0] == '-' || cell[0] == '+');
}

/// An unescaped bar would end the cell.
std::string escaped(const std::string& cell) {
  std::string text;
  for (const char c : cell) text += c == '|' ? "\\|" : std::string(1, c);
  return text;
}

}  // namespace

Text_table::Text_table(std::vector<std::string> header) {
  for (auto& cell : header) cell = escaped(cell);
  rows_.push_back(std::move(header));
}

void Text_table::add(std::vector<std::string> row) {
  if (row.size() != rows_.front().size())
    throw Bad_argument(fmt::format("a row of {} cells in a table of {} columns", row.size(), rows_.front().size()));
  for (auto& cell : row) cell = escaped(cell);
  rows_.push_back(std::move(row));
}

std::string Text_table::text() const {
  const std::size_t columns = rows_.front().size();
  std::vector<std::size_t> widths(columns, 3);
  std::vector<bool> numbers(columns, rows_.size() > 1);
  for (std::size_t r = 0; r < rows_.size(); ++r)
    for (std::size_t c = 0; c < columns; ++c) {
      widths[c] = std::max(widths[c], fmt::formatted_size("{}", rows_[r][c]));
      if (r > 0) numbers[c] = numbers[c] && is_number(rows_[r][c]);
    }

  std::string text;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    for (std::size_t c = 0; c < columns; ++c)
      text += numbers[c] ? fmt::format("| {:>{}} ", rows_[r][c], widths[c])
                         : fmt::format("| {:<{}} ", rows_[r][c], widths[c]);
    text += "|\n";
    if (r > 0) continue;
    for (std::size_t c = 0; c < columns; ++c)
      text += fmt::format("| {}{} ", std::string(widths[c] - 1, '-'), numbers[c] ? ":" : "-");
    text += "|\n";
  }
  return text;
}

}  // namespace lodestone
