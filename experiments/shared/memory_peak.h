// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace lodestone {

/// How much memory is resident at most from here on, beyond what was resident before. One at a time: each starts the
/// process's peak anew. Memory that was freed and not yet given back to the system counts as resident before.
class Memory_peak {
 public:
  Memory_peak();
  /// In bytes; 0 where the system does not tell.
  std::size_t bytes() const;

 private:
  std::size_t before_ = 0;
};

}  // namespace lodestone
