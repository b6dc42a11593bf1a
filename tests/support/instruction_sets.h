// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a test for every instruction set that the kernels are built for and the processor supports.
#pragma once

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdint>

namespace lodestone {

/// Calls `check()` for each instruction set, the best one first.
template <class Check>
void for_instruction_sets(const Check& check) {
  static const std::int64_t all = hwy::SupportedTargets();  // asks the processor, which is slow
  static const auto targets = hwy::SupportedAndGeneratedTargets();
  for (const auto target : targets) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::GetChosenTarget().Update(target);
    check();
  }
  hwy::GetChosenTarget().Update(all);
}

}  // namespace lodestone
