// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace lodestone {

/// A table for people: columns aligned in a terminal, and valid Markdown.
class Text_table {
 public:
  explicit Text_table(std::vector<std::string> header);

  /// @throws Bad_argument  another number of cells than the header has
  void add(std::vector<std::string> row);

  /// Cells that begin with a digit or a sign stand to the right. Ends with a line break.
  std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace lodestone
