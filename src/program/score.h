// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "lodestone/mesh/pairs.h"

namespace lodestone {

/// Compares the answers of a method with the truth, over all frames and object pairs it answered. A frame of a pair is
/// positive if the exact surfaces intersect. A collision is an unbroken run of positive frames of one pair.
class Score {
 public:
  /// Adds one frame of one pair. The frames of a pair must be added in order.
  void add(Object_pair pair, bool truth, bool answer);
  /// Ends all open collisions: call after the last frame.
  void finish();
  /// Adds the counts of another finished score.
  void add(const Score& other);

  double recall() const { return ratio(true_positives_, true_positives_ + false_negatives_); }
  double precision() const { return ratio(true_positives_, true_positives_ + false_positives_); }
  double accuracy() const { return ratio(true_positives_ + true_negatives_, frames()); }
  /// Mean number of frames from the start of a collision to its first detection, over the collisions that were
  /// detected.
  double mean_delay() const;
  std::size_t collisions() const { return delays_.size() + never_seen_; }
  std::size_t never_seen() const { return never_seen_; }
  std::size_t frames() const { return true_positives_ + false_positives_ + true_negatives_ + false_negatives_; }
  std::size_t positives() const { return true_positives_ + false_negatives_; }
  std::size_t false_positives() const { return false_positives_; }
  std::size_t false_negatives() const { return false_negatives_; }

 private:
  struct Collision {
    std::size_t frames = 0;
    std::optional<std::size_t> seen_after;
  };

  /// 1 if the denominator is zero.
  static double ratio(std::size_t part, std::size_t whole) {
    return whole == 0 ? 1 : static_cast<double>(part) / static_cast<double>(whole);
  }
  void end(const Collision& collision);

  std::size_t true_positives_ = 0, false_positives_ = 0, true_negatives_ = 0, false_negatives_ = 0;
  std::vector<std::size_t> delays_;
  std::size_t never_seen_ = 0;
  std::map<Object_pair, Collision> going_on_;
};

}  // namespace lodestone
