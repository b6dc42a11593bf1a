// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

namespace lodestone {

/// The template of pages.
/// @param page  path of the page that needs it, for the message
/// @throws Bad_output    the program was built without the viewer
std::string_view viewer_template(const std::filesystem::path& page);

}  // namespace lodestone
