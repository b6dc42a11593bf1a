// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "lodestone/io/files/atomic_file.h"
#include "lodestone/io/results/page.h"

namespace lodestone {

/// A page on its way to its file, which appears with `commit` or not at all.
class Page_file {
 public:
  /// @param other  another result, which must not be the same file; empty: there is none
  /// @throws Bad_argument  the name does not end in .html, or is that of the other
  /// @throws Bad_output    as viewer_template and Atomic_file
  Page_file(const std::filesystem::path& target, const std::filesystem::path& other);

  /// Writes, and waits until the page is on disk.
  void finish(const Page& page);
  void commit() { file_.commit(); }
  /// Name and size, for the user.
  std::string summary() const;

 private:
  std::filesystem::path target_;
  std::string_view template_;
  Atomic_file file_;
  std::size_t bytes_ = 0;
};

}  // namespace lodestone
