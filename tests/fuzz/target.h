// SPDX-License-Identifier: GPL-3.0-or-later
// What all fuzz targets share: how a target is defined, and what counts as a failure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lodestone/mesh/errors.h"

namespace lodestone::fuzz {

/// The bytes that a fuzzer has made up.
using Input = std::span<const std::uint8_t>;

/// A function that is called with any bytes, and must not crash, hang, leak or fail.
struct Target {
  const char* name;
  void (*run)(Input input);
};

/// All targets of this program.
std::vector<Target>& targets();
/// Adds a target to the list, for a global variable.
bool add_target(const Target& target);

/// Ends the process with a message: the library has given a wrong answer.
[[noreturn]] void fail(const std::string& message);
inline void require(bool holds, const std::string& otherwise) {
  if (!holds) fail(otherwise);
}

/// The message of a typed error must be one line.
void check_message(const Error& error);

/// Calls a function that may refuse its input by a typed error of the library, and by nothing else: any other exception
/// leaves, and ends the process.
/// @return whether the input was accepted
template <class Call>
bool accepts(const Call& call) {
  try {
    call();
    return true;
  } catch (const Error& error) {
    check_message(error);
    return false;
  }
}

}  // namespace lodestone::fuzz

// Defines a target: LODESTONE_FUZZ_TARGET(off) { ... input ... }. Built with libFuzzer, a program has one target, which
// libFuzzer calls. Else a program has several, each of which `replay.cpp` calls by its name.
#ifdef LODESTONE_WITH_LIBFUZZER
#define LODESTONE_FUZZ_TARGET(NAME)                                                   \
  static void run_##NAME(lodestone::fuzz::Input input);                               \
  extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) { \
    run_##NAME({data, size});                                                         \
    return 0;                                                                         \
  }                                                                                   \
  static void run_##NAME([[maybe_unused]] lodestone::fuzz::Input input)
#else
#define LODESTONE_FUZZ_TARGET(NAME)                                                                      \
  static void run_##NAME(lodestone::fuzz::Input input);                                                  \
  [[maybe_unused]] static const bool NAME##_is_added = lodestone::fuzz::add_target({#NAME, run_##NAME}); \
  static void run_##NAME([[maybe_unused]] lodestone::fuzz::Input input)
#endif
