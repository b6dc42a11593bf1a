// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <concepts>
#include <memory>

#include "lodestone/detection/exact_detection.h"
#include "lodestone/detection/particle_detection.h"

namespace lodestone {

/// The model of Detection for the mode that the options name: the only place that makes them.
/// @throws Bad_argument  an option out of range
template <Bounding_volume Volume>
std::unique_ptr<Detection> make_detection(const Detector_options& options) {
  check(options);
  check(options.particle_count);
  check(options.senin);
  switch (options.mode) {
    case Mode::particles:
    case Mode::senin:
      return std::make_unique<Particle_detection>(options);
    case Mode::exact:
      return std::make_unique<Exact_detection<Volume>>(options);
    case Mode::certified:
      if constexpr (std::same_as<Volume, Aabb>) return std::make_unique<Exact_detection<Volume>>(options);
      throw Bad_argument("the mode certified needs boxes as volumes");
  }
  throw Bad_argument("there is no such mode");
}

}  // namespace lodestone
