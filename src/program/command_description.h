// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

/// What a command line takes, as JSON, of which scripts/document_program makes the man page and the completions of
/// shells. In a header for the same reason as command_line.h.
namespace lodestone {

/// Names of the choices as the name of a validator, which help does not show: descriptions find them there.
inline std::string choices_name(const std::vector<std::string>& choices) {
  return fmt::format("{}", fmt::join(choices, "|"));
}

/// Accepts one of these words.
inline CLI::Validator one_word_of(const std::vector<std::string>& words) {
  return CLI::IsMember(words).description("").name(choices_name(words));
}

/// The words that an option accepts; empty if others are accepted too.
inline std::vector<std::string> choices_of(CLI::Option& option) {
  std::vector<std::string> choices;
  try {
    std::istringstream names(option.get_validator(0)->get_name());
    for (std::string name; std::getline(names, name, '|');) choices.push_back(name);
  } catch (const CLI::OptionNotFound&) {  // CLI11 has no other way to tell that there is no validator
  }
  return choices;
}

inline nlohmann::ordered_json description_of(CLI::Option& option) {
  nlohmann::ordered_json json;
  json["names"] = nlohmann::ordered_json::array();
  for (const auto& name : option.get_snames()) json["names"].push_back("-" + name);
  for (const auto& name : option.get_lnames()) json["names"].push_back("--" + name);
  if (option.get_positional()) json["positional"] = option.get_name(true);
  json["text"] = option.get_description();
  if (option.get_items_expected_max() == 0) return json;  // a flag
  // `UINT:0 or more`: the type, and what its values must be
  const std::string type = option.get_type_name();
  const auto colon = type.find(':');
  json["type"] = type.substr(0, colon);
  if (colon != std::string::npos) json["range"] = type.substr(colon + 1);
  if (const auto choices = choices_of(option); !choices.empty()) json["choices"] = choices;
  if (!option.get_default_str().empty()) json["default"] = option.get_default_str();
  json["many"] = option.get_items_expected_max() > 1;
  json["required"] = option.get_required();
  return json;
}

/// Options and commands that help shows.
inline nlohmann::ordered_json description_of(CLI::App& app) {
  nlohmann::ordered_json json{{"name", app.get_name()}, {"text", app.get_description()}, {"footer", app.get_footer()}};
  json["options"] = nlohmann::ordered_json::array();
  for (auto* option : app.get_options()) json["options"].push_back(description_of(*option));
  json["commands"] = nlohmann::ordered_json::array();
  for (auto* command : app.get_subcommands(nullptr)) json["commands"].push_back(description_of(*command));
  return json;
}

}  // namespace lodestone
