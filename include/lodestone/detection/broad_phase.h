// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/box.h"
#include "lodestone/mesh/pairs.h"

namespace lodestone {

/// The broad phase: object pairs whose surfaces may be nearer than the tolerance. In mode `particles` those whose
/// regions may touch; without meetings, and in mode `senin`, those whose particles may feel each other or come near
/// each other.
class Broad_phase {
 public:
  /// Makes room for so many objects.
  void reserve(std::size_t objects);

  /// Pairs of boxes that overlap when one is grown on all sides by the larger of their two reaches, sorted. Sorts the
  /// boxes along the axis along which the fewest overlap, starting from the order of the last frame, and sweeps them in
  /// strips across it: O(n + pairs that overlap along both) while little changes, and O(n log n) more if much does.
  /// The result is valid until the next call.
  ///
  /// @param ids    n objects that have not been removed, ascending
  /// @param boxes  by id: around all of the object, or its regions, or its particles
  /// @param reach  by id: the tolerance; 0 for regions, which have grown already; how far particles are felt, or near
  std::span<const Object_pair> find(std::span<const std::uint32_t> ids, std::span<const Box> boxes,
                                    std::span<const double> reach);

 private:
  struct Interval {
    double begin, end;
    /// Without a branch, which would often be mispredicted.
    friend bool overlap(const Interval& a, const Interval& b) { return (a.begin <= b.end) & (b.begin <= a.end); }
  };
  /// A box grown by its reach.
  struct Grown_box {
    Interval along, across, third;
    std::uint32_t id;
  };

  std::size_t take(std::span<const std::uint32_t> ids);
  static Interval grown(const Box& box, double reach, int axis);
  void choose_axes(std::span<const Box> boxes, std::span<const double> reach);
  void sort(std::span<const std::uint32_t> ids, std::span<const Box> boxes, std::span<const double> reach);
  double strip_width(std::span<const Box> boxes, std::span<const double> reach) const;
  void choose_strips(std::span<const Box> boxes, std::span<const double> reach);
  bool count_in_strips(std::span<const Box> boxes, std::span<const double> reach);
  void divide(std::span<const Box> boxes, std::span<const double> reach);
  std::int64_t place_across(double coordinate) const;
  std::size_t strip_at(std::int64_t place) const { return static_cast<std::size_t>(place) & (strips_ - 1); }
  template <class Visit>
  void visit_strips(const Interval& across, const Visit& visit) const;
  bool meet_in(std::size_t strip, const Interval& a, const Interval& b) const;

  std::vector<std::uint32_t> ids_;    ///< of the last frame
  std::vector<std::uint32_t> order_;  ///< the same along the axis
  int axis_ = 0, across_ = 1;
  bool divides_ = false;              ///< whether strips across the axis pay
  double width_ = 0;                  ///< of a strip
  std::size_t strips_ = 1;            ///< a power of two
  std::vector<Grown_box> in_strips_;  ///< the boxes of one strip after the other
  std::vector<std::size_t> ends_;     ///< per strip: where its boxes end
  std::vector<Object_pair> pairs_;
};

}  // namespace lodestone
