// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>

namespace lodestone {

/// Counts the poses of computed points, from 1. An assignment is a new pose too: it makes the number greater than both
/// were, so that nobody who knows the number of the pose before takes the new one for it. Assignments are also counted
/// for themselves, since they can change more than the pose.
class Pose_number {
 public:
  /// The first pose.
  Pose_number() = default;
  /// A copy is in the same pose.
  Pose_number(const Pose_number& other) = default;
  ~Pose_number() = default;
  /// A new pose.
  Pose_number& operator=(const Pose_number& other) {
    number_ = std::max(number_, other.number_) + 1;
    assignments_ = std::max(assignments_, other.assignments_) + 1;
    return *this;
  }

  /// The number of the pose.
  /*implicit*/ operator std::uint64_t() const { return number_; }
  /// Grows with each assignment, in the same way.
  std::uint64_t assignments() const { return assignments_; }
  /// A new pose.
  Pose_number& operator++() {
    ++number_;
    return *this;
  }

 private:
  std::uint64_t number_ = 1, assignments_ = 0;
};

}  // namespace lodestone
