// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/global_control.h>

#include <optional>

namespace lodestone {

/// Takes the machine for another one if the environment says so. Results do not depend on it, which this is to show:
///
/// - `LODESTONE_INSTRUCTION_SET` names the instruction set of the kernels, such as AVX2, in place of the best one;
/// - `LODESTONE_MOST_THREADS` is the number of threads that `--threads` can ask for, even of fewer processors.
class Assumed_machine {
 public:
  /// For as long as this lives.
  /// @throws Bad_argument  there is no such instruction set here; the number is none
  Assumed_machine();

 private:
  std::optional<tbb::global_control> threads_;
};

}  // namespace lodestone
