// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared/memory_peak.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>

namespace lodestone {

namespace {

/// A line of /proc/self/status, in bytes; 0 where there is none.
std::size_t status_bytes(std::string_view key) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (std::size_t kilobytes = 0; word == key && status >> kilobytes) return 1024 * kilobytes;
  return 0;
}

}  // namespace

Memory_peak::Memory_peak() {
  std::ofstream("/proc/self/clear_refs") << 5;  // the peak is from here on
  before_ = status_bytes("VmRSS:");
}

std::size_t Memory_peak::bytes() const { return std::max(status_bytes("VmHWM:"), before_) - before_; }

}  // namespace lodestone
