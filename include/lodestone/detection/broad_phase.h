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
  /// boxes along the axis along which they are spread most, starting from the order of the last frame: O(n + pairs that
  /// overlap along it) while little changes, and O(n log n) more if much does. The result is valid until the next call.
  ///
  /// @param ids    n objects that have not been removed, ascending
  /// @param boxes  by id: around the particles of the object, or around all of it
  /// @param reach  by id: how far its particles are felt, or taken as near; or the tolerance
  std::span<const Object_pair> find(std::span<const std::uint32_t> ids, std::span<const Box> boxes,
                                    std::span<const double> reach);

 private:
  std::size_t take(std::span<const std::uint32_t> ids);
  bool choose_axis(std::span<const Box> boxes);

  std::vector<std::uint32_t> ids_;    ///< of the last frame
  std::vector<std::uint32_t> order_;  ///< the same along the axis
  int axis_ = 0;
  std::vector<Object_pair> pairs_;
};

}  // namespace lodestone
