// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/target.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace lodestone::fuzz {

std::vector<Target>& targets() {
  static std::vector<Target> all;
  return all;
}

bool add_target(const Target& target) {
  targets().push_back(target);
  return true;
}

void fail(const std::string& message) {
  std::fprintf(stderr, "WRONG: %s\n", message.c_str());
  std::abort();
}

void check_message(const Error& error) {
  const std::string message = error.what();
  require(!message.empty(), "an error without a message");
  const bool one_line = std::ranges::none_of(message, [](char c) { return c == '\n' || c == '\r'; });
  require(one_line, "an error of several lines: " + message);
}

}  // namespace lodestone::fuzz
