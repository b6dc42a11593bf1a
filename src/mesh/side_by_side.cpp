// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/mesh/side_by_side.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace lodestone {

namespace {

/// Whether no worker is left idle for much longer than the others work.
bool are_alike(std::span<const std::size_t> sizes, std::size_t workers) {
  const std::size_t all = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
  return 2 * workers * std::ranges::max(sizes) <= 3 * all;
}

}  // namespace

void side_by_side(std::span<const std::size_t> sizes, Workers& workers,
                  const std::function<void(std::size_t, Workers&)>& work, std::size_t shared_from) {
  std::vector<std::size_t> others, other_sizes;
  for (std::size_t index = 0; index < sizes.size(); ++index) {
    if (sizes[index] >= shared_from) {
      work(index, workers);
    } else {
      others.push_back(index);
      other_sizes.push_back(sizes[index]);
    }
  }
  std::size_t alone = others.size() - others.size() % workers.count();
  if (workers.count() == 1 || alone == 0 || !are_alike(other_sizes, workers.count())) alone = 0;
  workers.run(alone, [&](std::size_t i, std::size_t) { work(others[i], Workers::alone()); });
  for (std::size_t i = alone; i < others.size(); ++i) work(others[i], workers);
}

}  // namespace lodestone
