// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace lodestone {

/// The finished runs of a sweep in a file of JSON Lines: a line per run, keyed by its `id`.
///
/// A line is on disk before `add` returns. If the machine or the program stopped within a line, the cut-off line is
/// dropped when the file is next opened. Only one program at a time can have the file open.
class Row_file {
 public:
  using Row = nlohmann::ordered_json;

  /// What to do with a file in which a line is no JSON object with an `id`.
  enum class Damage {
    refuse,
    drop,  ///< cut off that line and all after it
  };

  /// Opens the file, or makes it with its folder.
  /// @throws Bad_output  it cannot be opened, or another program has it open
  /// @throws Bad_argument  it is damaged, and that is refused
  explicit Row_file(std::filesystem::path file, Damage damage = Damage::refuse);
  Row_file(const Row_file&) = delete;
  Row_file& operator=(const Row_file&) = delete;
  ~Row_file();

  bool has(const std::string& id) const { return rows_.contains(id); }
  /// Adds a row, unless the file has one with that id.
  /// @throws Bad_output
  void add(const Row& row);
  const std::map<std::string, Row>& rows() const { return rows_; }
  /// Removes all rows.
  /// @throws Bad_output
  void clear();

 private:
  [[noreturn]] void fail(const char* action) const;

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::map<std::string, Row> rows_;
};

/// Reads the rows of a file, whether or not a program has it open. A cut-off line at its end is left out.
/// @throws Bad_argument  no such file; as Row_file
std::map<std::string, Row_file::Row> read_rows(const std::filesystem::path& file);

}  // namespace lodestone
