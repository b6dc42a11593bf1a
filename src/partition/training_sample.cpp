// SPDX-License-Identifier: GPL-3.0-or-later
#include "partition/training_sample.h"

#include <algorithm>
#include <random>

namespace lodestone {

namespace {

/// Where run number `run` of `runs` begins.
std::size_t run_begin(std::size_t vectors, std::size_t runs, std::size_t run) { return run * vectors / runs; }

}  // namespace

std::size_t sample_size(std::size_t vectors, std::size_t cells, std::size_t most) {
  constexpr std::size_t per_cell = 128;
  if (most == 0 || cells >= vectors / per_cell) return vectors;
  return std::min(vectors, std::max(most, per_cell * cells));
}

std::vector<std::uint32_t> draw_sample(std::size_t vectors, std::size_t size) {
  std::mt19937_64 random(1);
  std::vector<std::uint32_t> sample(size);
  for (std::size_t run = 0; run < size; ++run) {
    const std::size_t begin = run_begin(vectors, size, run), length = run_begin(vectors, size, run + 1) - begin;
    sample[run] = static_cast<std::uint32_t>(begin + random() % length);
  }
  return sample;
}

std::vector<Region_index> labels_from_sample(std::size_t vectors, std::span<const Region_index> sample_labels) {
  std::vector<Region_index> labels;
  labels.reserve(vectors);
  for (std::size_t run = 0; run < sample_labels.size(); ++run)
    labels.resize(run_begin(vectors, sample_labels.size(), run + 1), sample_labels[run]);
  return labels;
}

}  // namespace lodestone
