// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lodestone {

/// A mesh from the standard input, kept as a file: readers map their files into memory. The file disappears with this.
class Standard_input {
 public:
  /// Reads the standard input to its end.
  /// @param format  extension without the dot, such as `obj`
  /// @throws Bad_output    the temporary file cannot be written
  explicit Standard_input(const std::string& format);
  ~Standard_input();
  Standard_input(const Standard_input&) = delete;
  Standard_input& operator=(const Standard_input&) = delete;

  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path folder_, file_;
};

/// Replaces an input that is `-` by the standard input.
/// @param format  of the standard input; empty: not given
/// @param kept    receives the standard input, which must live as long as it is read
/// @throws Bad_argument  `-` twice or without a format, a format without `-`
void replace_standard_input(std::vector<std::filesystem::path*> inputs, const std::string& format,
                            std::optional<Standard_input>& kept);

}  // namespace lodestone
