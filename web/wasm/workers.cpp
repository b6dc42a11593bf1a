// SPDX-License-Identifier: GPL-3.0-or-later
// In a browser there is one thread.
#include "lodestone/mesh/workers.h"

namespace lodestone {

struct Workers::Threads {};

Workers::Workers(std::size_t /*threads*/) : count_(1) {}
Workers::~Workers() = default;
Workers::Workers(Workers&&) noexcept = default;

Workers& Workers::alone() {
  static Workers workers(1);
  return workers;
}

void Workers::run(std::size_t tasks, const std::function<void(std::size_t, std::size_t)>& task) {
  for (std::size_t index = 0; index < tasks; ++index) task(index, 0);
}

}  // namespace lodestone
