// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scenes/shared_clock.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace lodestone {

namespace {

/// Rates and times that files hold as 32-bit numbers differ a little from those that were meant.
constexpr double rounding = 1e-4;

/// Whether the numbers differ by less than `tolerance`.
bool are_alike(const std::vector<double>& numbers, double tolerance) {
  if (numbers.empty()) return true;
  const auto [least, greatest] = std::minmax_element(numbers.begin(), numbers.end());
  return *greatest - *least < tolerance;
}

double least_of(const std::vector<double>& numbers) { return *std::min_element(numbers.begin(), numbers.end()); }

}  // namespace

void share_clock(std::span<Scene_object> objects) {
  std::vector<double> rates, starts, given_rates, given_starts;
  for (const auto& object : objects) {
    // What stands still has no rate that matters.
    if (object.motion.frames_per_second == 0 || (object.motion.resampled && object.motion.frames == 1)) continue;
    rates.push_back(object.motion.frames_per_second);
    starts.push_back(object.motion.start);
    if (object.motion.resampled) continue;
    given_rates.push_back(object.motion.frames_per_second);
    given_starts.push_back(object.motion.start);
  }
  if (rates.empty()) return;
  const double slowest = least_of(rates);
  const auto are_one_rate = [&](const std::vector<double>& some) { return are_alike(some, rounding * slowest); };
  const auto are_one_start = [&](const std::vector<double>& some) { return are_alike(some, rounding / slowest); };
  if (are_one_rate(rates) && are_one_start(starts)) return;
  const bool one_is_given = !given_rates.empty() && are_one_rate(given_rates);
  const double rate = one_is_given ? least_of(given_rates) : are_one_rate(rates) ? slowest : usual_rate;
  const double start = !given_starts.empty() && are_one_start(given_starts) ? least_of(given_starts) : 0;
  for (auto& object : objects) {
    if (!object.motion.resampled) continue;
    auto motion = object.motion.resampled(rate, start);
    motion.animations = std::move(object.motion.animations);  // they say whether a scene has chosen one
    motion.joined = std::move(object.motion.joined);
    object.motion = std::move(motion);
  }
}

}  // namespace lodestone
