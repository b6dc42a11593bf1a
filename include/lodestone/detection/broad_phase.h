// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/box.h"
#include "lodestone/mesh/pairs.h"

namespace lodestone {

/// The broad phase: object pairs whose particles may feel each other or come near each other; in mode `exact` those
/// whose surfaces may be nearer than the tolerance.
class Broad_phase {
 public:
  /// Makes room for so many objects.
  void reserve(std::size_t objects);

  /// Pairs of boxes that overlap when one is grown on all sides by the larger of their two reaches, sorted. Sorts the
  /// boxes along x, starting from the order of the last frame: O(n + pairs that overlap along x) while little changes,
  /// O(n^2) at worst. The result is valid until the next call.
  ///
  /// @param boxes  around the particles of each object, or around all of it
  /// @param reach  per object: how far its particles are felt, or taken as near; or the tolerance
  std::span<const Object_pair> find(std::span<const Box> boxes, std::span<const double> reach);

 private:
  std::vector<std::uint32_t> order_;
  std::vector<Object_pair> pairs_;
};

}  // namespace lodestone
