// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace lodestone {

/// A table that has aligned columns in a terminal and is valid Markdown.
class Text_table {
 public:
  /// A table without rows.
  /// @param header  one title per column
  explicit Text_table(std::vector<std::string> header);

  /// Adds a row.
  /// @throws Bad_argument  the number of cells differs from that of the header
  void add(std::vector<std::string> row);

  /// The table, ending with a line break. Columns whose cells all begin with a digit or a sign are right-aligned.
  std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace lodestone
