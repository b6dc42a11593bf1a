// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/side_by_side.h"

#include <algorithm>
#include <numeric>

namespace lodestone {

namespace {

/// Whether no worker is left idle for much longer than the others work.
bool are_alike(std::span<const std::size_t> sizes, std::size_t workers) {
  const std::size_t all = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
  return 2 * workers * std::ranges::max(sizes) <= 3 * all;
}

}  // namespace

void side_by_side(std::span<const std::size_t> sizes, Workers& workers,
                  const std::function<void(std::size_t, Workers&)>& work) {
  std::size_t alone = sizes.size() - sizes.size() % workers.count();
  if (workers.count() == 1 || alone == 0 || !are_alike(sizes, workers.count())) alone = 0;
  workers.run(alone, [&](std::size_t index, std::size_t) { work(index, Workers::alone()); });
  for (std::size_t index = alone; index < sizes.size(); ++index) work(index, workers);
}

}  // namespace lodestone
