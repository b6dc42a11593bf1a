// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/assumed_machine.h"

#include <fmt/format.h>
#include <hwy/targets.h>

#include <charconv>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

std::string_view environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? std::string_view() : std::string_view(value);
}

void choose_instruction_set(std::string_view wanted) {
  std::vector<std::string_view> names;
  for (const auto target : hwy::SupportedAndGeneratedTargets()) {
    names.emplace_back(hwy::TargetName(target));
    if (names.back() != wanted) continue;
    hwy::GetChosenTarget().Update(target);
    return;
  }
  throw Bad_argument(
      fmt::format("LODESTONE_INSTRUCTION_SET: expected {}, found '{}'", fmt::join(names, " or "), wanted));
}

std::size_t thread_count(std::string_view text) {
  constexpr std::size_t most = 1024;
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size() || count < 1 || count > most)
    throw Bad_argument(fmt::format("LODESTONE_MOST_THREADS: expected 1 to {}, found '{}'", most, text));
  return count;
}

}  // namespace

Assumed_machine::Assumed_machine() {
  const auto instruction_set = environment("LODESTONE_INSTRUCTION_SET"),
             threads = environment("LODESTONE_MOST_THREADS");
  if (!instruction_set.empty()) choose_instruction_set(instruction_set);
  if (!threads.empty()) threads_.emplace(tbb::global_control::max_allowed_parallelism, thread_count(threads));
}

}  // namespace lodestone
