// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <set>
#include <vector>

#include "lodestone/detection/broad_phase.h"
#include "lodestone/detection/collision_groups.h"
#include "lodestone/detection/detector_options.h"

namespace lodestone {

/// Which object pairs a detector looks at: those that meet each other's groups, without those that are ignored.
class Collision_filter {
 public:
  /// Adds an object, with its groups.
  void add(const Object_options& object) { objects_.push_back({object.groups, object.meets}); }
  /// Undoes the last `add`.
  void take_back() { objects_.pop_back(); }
  /// Leaves out all pairs of an object from now on. O(ignored pairs).
  void remove(std::uint32_t object) {
    objects_[object] = {.groups = 0, .meets = 0};
    std::erase_if(ignored_, [object](const Object_pair& pair) { return pair.a == object || pair.b == object; });
  }
  /// Leaves out a pair, or takes it in again. O(log ignored pairs).
  void ignore(Object_pair pair, bool ignored) {
    if (ignored)
      ignored_.insert(ordered(pair));
    else
      ignored_.erase(ordered(pair));
  }
  /// Whether a face of a and a face of b, or two faces of a = b, may be reported.
  bool may_collide(std::uint32_t a, std::uint32_t b) const {
    if (!meet(objects_[a], objects_[b])) return false;
    return ignored_.empty() || !ignored_.contains(ordered({a, b}));
  }

 private:
  static Object_pair ordered(Object_pair pair) { return {std::min(pair.a, pair.b), std::max(pair.a, pair.b)}; }

  std::vector<Collision_groups> objects_;
  std::set<Object_pair> ignored_;
};

}  // namespace lodestone
