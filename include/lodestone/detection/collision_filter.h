// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "lodestone/detection/collision_groups.h"
#include "lodestone/detection/detector_options.h"
#include "lodestone/mesh/pairs.h"

namespace lodestone {

/// Which object pairs a detector looks at: those that meet each other's groups, without those that are ignored.
class Collision_filter {
 public:
  /// Adds an object, with its groups.
  void add(const Object_options& object) { objects_.push_back({{object.groups, object.meets}, {}}); }
  /// Undoes the last `add`.
  void take_back() { objects_.pop_back(); }
  /// Leaves out all pairs of an object from now on. O(n log n) for its n ignored pairs.
  void remove(std::uint32_t object) {
    for (const auto other : objects_[object].ignored)
      if (other != object) objects_[other].ignored.erase(object);
    objects_[object] = {.groups = {.groups = 0, .meets = 0}, .ignored = {}};
  }
  /// Leaves out a pair, or takes it in again. O(log n) for n ignored pairs of one of the two.
  void ignore(Object_pair pair, bool ignored) {
    auto &of_a = objects_[pair.a].ignored, &of_b = objects_[pair.b].ignored;
    if (!ignored) {
      of_a.erase(pair.b);
      of_b.erase(pair.a);
    } else if (of_a.insert(pair.b).second && pair.a != pair.b) {
      try {
        of_b.insert(pair.a);
      } catch (...) {
        of_a.erase(pair.b);
        throw;
      }
    }
  }
  /// Whether a face of a and a face of b, or two faces of a = b, may be reported.
  bool may_collide(std::uint32_t a, std::uint32_t b) const {
    return meet(objects_[a].groups, objects_[b].groups) && !objects_[a].ignored.contains(b);
  }

 private:
  struct Object {
    Collision_groups groups;
    std::set<std::uint32_t> ignored = {};  ///< objects with which its pairs are left out
  };

  std::vector<Object> objects_;
};

}  // namespace lodestone
