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

}  // namespace

void share_clock(std::span<Scene_object> objects) {
  std::vector<double> rates, given, starts;
  for (const auto& object : objects) {
    if (object.motion.frames_per_second == 0) continue;
    rates.push_back(object.motion.frames_per_second);
    starts.push_back(object.motion.start);
    if (!object.motion.resampled) given.push_back(object.motion.frames_per_second);
  }
  if (rates.empty()) return;
  const double fastest = *std::max_element(rates.begin(), rates.end());
  const auto are_one_rate = [&](const std::vector<double>& some) { return are_alike(some, rounding * fastest); };
  if (are_one_rate(rates) && are_alike(starts, rounding / fastest)) return;
  const bool one_is_given = !given.empty() && are_one_rate(given);
  const double common = one_is_given ? given.front() : are_one_rate(rates) ? rates.front() : usual_rate;
  for (auto& object : objects) {
    if (!object.motion.resampled) continue;
    auto motion = object.motion.resampled(common);
    motion.animations = std::move(object.motion.animations);  // they say whether a scene has chosen one
    object.motion = std::move(motion);
  }
}

}  // namespace lodestone
