// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>

/// What a glTF file holds and Lodestone does not read. The documents have passed the guard.
namespace lodestone {

/// Extensions that say where surfaces are. A file may call them optional, but without them it shows something else.
std::set<std::string> ignored_extensions(const nlohmann::json& document);

/// What else it holds beside positions and their motion, such as `texture coordinates`.
std::set<std::string> unread_content(const nlohmann::json& document);

}  // namespace lodestone
