// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/small_text.h"
#include "lodestone/mesh/errors.h"
#include "program/command_description.h"
#include "program/exit_codes.h"
#include "program/plain_words.h"
#include "program/suggestion.h"

namespace lodestone {

namespace {

/// Whole numbers are decimal: CLI11 reads 010 as 8, and takes the nearest number for one that is too large.
CLI::Validator decimal() {
  return {[](const std::string& text) -> std::string {
            std::uint64_t value = 0;
            const char* const end = text.data() + text.size();
            const auto read = std::from_chars(text.data(), end, value);
            const bool is_plain = text.size() == 1 || !text.starts_with('0');
            if (read.ec == std::errc() && read.ptr == end && is_plain) return {};
            if (read.ec == std::errc::result_out_of_range && read.ptr == end)
              return fmt::format("expected at most {}, found '{}'", std::numeric_limits<std::uint64_t>::max(), text);
            return fmt::format("expected a whole number in decimal digits, found '{}'", text);
          },
          ""};
}

/// Lets all options that take whole numbers, of all commands, take decimal ones only.
void read_decimals(CLI::App& app) {
  for (auto* option : app.get_options())
    if (option->get_type_name().find("UINT") != std::string::npos) option->check(decimal());
  for (auto* command : app.get_subcommands(nullptr)) read_decimals(*command);
}

/// The sub-command of this name; null if there is none.
const CLI::App* find_command(const CLI::App& program, const std::string& name) {
  for (const auto* command : program.get_subcommands(nullptr))
    if (command->get_name() == name) return command;
  return nullptr;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& words) {
  const auto meant = suggestion_for(word, words);
  return meant.empty() ? "" : fmt::format("; did you mean {}?", meant);
}

/// A complaint about the first option that `app` does not have; empty if there is none.
std::string unknown_option(const CLI::App& app, std::span<char* const> words) {
  std::vector<std::string> known;
  for (const auto* option : app.get_options())
    for (const auto& name : option->get_lnames()) known.push_back("--" + name);
  for (const std::string word : words) {
    const auto name = word.substr(0, word.find('='));
    if (name == "--") return {};
    if (name.starts_with("--") && std::ranges::find(known, name) == known.end())
      return fmt::format("there is no option {}{}", name, did_you_mean(name, known));
  }
  return {};
}

/// A complaint about a misspelt command or option; empty if there is none.
std::string unknown_word(const CLI::App& program, std::span<char* const> words) {
  std::vector<std::string> commands;
  for (const auto* command : program.get_subcommands(nullptr)) commands.push_back(command->get_name());
  if (commands.empty() || words.empty() || *words[0] == '-') return unknown_option(program, words);
  const auto* command = find_command(program, words[0]);
  if (command != nullptr) return unknown_option(*command, words.subspan(1));
  return fmt::format("there is no command {}{}", words[0], did_you_mean(words[0], commands));
}

/// The words of the command line, in which files after `--` cannot be taken for options: CLI11 refuses `--` after the
/// first file. `submit` has a command there.
std::vector<std::string> unmistakable_words(int argc, char** argv) {
  std::vector<std::string> words(argv, argv + argc);
  return argc > 1 && words[1] == "submit" ? words : plain_words(words);
}

}  // namespace

CLI::Validator not_empty() {
  return {[](const std::string& text) { return std::string(text.empty() ? "expected a name, found none" : ""); }, ""};
}

CLI::Validator finite_number(double least, double most, const std::string& range) {
  return {[least, most, range](const std::string& text) {
            char* end = nullptr;
            const double number = std::strtod(text.c_str(), &end);
            const bool is_in_range =
                !text.empty() && *end == 0 && std::isfinite(number) && number >= least && number <= most;
            return is_in_range ? std::string() : fmt::format("not a finite number of {}: {}", range, text);
          },
          range};
}

CLI::Validator number_above_0(bool may_be_infinite) {
  const std::string range = may_be_infinite ? "a number above 0" : "a finite number above 0";
  return {[may_be_infinite, range](const std::string& text) {
            char* end = nullptr;
            const double number = std::strtod(text.c_str(), &end);
            const bool is_accepted =
                !text.empty() && *end == 0 && number > 0 && (may_be_infinite || std::isfinite(number));
            return is_accepted ? std::string() : fmt::format("not {}: {}", range, text);
          },
          "above 0"};
}

CLI::Option* add_html(CLI::App& app, std::filesystem::path& html, const char* what) {
  return app.add_option("--html", html, what)->type_name("FILE")->check(not_empty());
}

std::optional<int> parse(CLI::App& program, int argc, char** argv) {
  if (argc == 2 && std::string_view(argv[1]) == "--describe") {
    fmt::print("{}\n", description_of(program).dump(2));
    return exit_code::success;
  }
  read_decimals(program);
  try {
    auto words = unmistakable_words(argc, argv);
    std::vector<char*> pointers;
    for (auto& word : words) pointers.push_back(word.data());
    program.parse(static_cast<int>(pointers.size()), pointers.data());
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    const bool asked_for_help = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
    if (asked_for_help) {
      errno = 0;
      const int code = program.exit(error);
      if (!std::cout.flush() && errno == EPIPE) return exit_code::reader_left;
      if (!std::cout) throw Bad_output("the standard output cannot be written");
      return code;
    }
    auto complaint = unknown_word(program, std::span(argv, static_cast<std::size_t>(argc)).subspan(1));
    if (complaint.empty()) complaint = error.what();
    const auto* const command = argc > 1 ? find_command(program, argv[1]) : nullptr;
    fmt::print(stderr, "lodestone: {} (see {}{} --help)\n", printable(complaint), program.get_name(),
               command != nullptr ? " " + command->get_name() : "");
    return exit_code::bad_usage;
  }
}

}  // namespace lodestone
