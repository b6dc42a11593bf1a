// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "lodestone/io/files/atomic_file.h"
#include "lodestone/io/results/page.h"

namespace lodestone {

/// A page that is being written to a file, which appears with `commit` or not at all.
class Page_file {
 public:
  /// @param other  path of another result, which must not be the same file; empty: none
  /// @throws Bad_argument  the name does not end in .html, or equals `other`
  /// @throws Bad_output    as viewer_template and Atomic_file
  Page_file(const std::filesystem::path& target, const std::filesystem::path& other);

  /// Writes, and waits until the page is on disk.
  void finish(const Page& page);
  void commit() { file_.commit(); }
  /// Name and size, as a message for the user.
  std::string summary() const;

 private:
  std::filesystem::path target_;
  std::string_view template_;
  Atomic_file file_;
  std::size_t bytes_ = 0;
};

}  // namespace lodestone
