// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/page_file.h"

#include <fmt/format.h>

#include "io/files/small_text.h"
#include "lodestone/mesh/errors.h"
#include "program/viewer.h"

namespace lodestone {

namespace {

const std::filesystem::path& checked(const std::filesystem::path& target, const std::filesystem::path& other) {
  if (lower_case(target.extension().string()) != ".html")
    throw Bad_argument(target.string() + ": a page is written as .html");
  std::error_code unknown;
  if (!other.empty() && weakly_canonical(target, unknown) == weakly_canonical(other, unknown))
    throw Bad_argument(target.string() + ": the page and another result cannot be the same file");
  return target;
}

}  // namespace

Page_file::Page_file(const std::filesystem::path& target, const std::filesystem::path& other)
    : target_(checked(target, other)), template_(viewer_template(target)), file_(target) {}

void Page_file::finish(const Page& page) {
  bytes_ = write_page(file_, template_, page.title(), page.data());
  file_.finish();
}

std::string Page_file::summary() const {
  return fmt::format("page: {}, {:.1f} MB", printable(target_.string()), 1e-6 * static_cast<double>(bytes_));
}

}  // namespace lodestone
