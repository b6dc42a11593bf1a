// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/score.h"

#include <numeric>

namespace lodestone {

void Score::add(Object_pair pair, bool truth, bool answer) {
  ++(truth ? (answer ? true_positives_ : false_negatives_) : (answer ? false_positives_ : true_negatives_));
  if (truth) {
    Collision& collision = going_on_[pair];
    if (answer && !collision.seen_after) collision.seen_after = collision.frames;
    ++collision.frames;
  } else if (const auto found = going_on_.find(pair); found != going_on_.end()) {
    end(found->second);
    going_on_.erase(found);
  }
}

void Score::end(const Collision& collision) {
  if (collision.seen_after)
    delays_.push_back(*collision.seen_after);
  else
    ++never_seen_;
}

void Score::finish() {
  for (const auto& [pair, collision] : going_on_) end(collision);
  going_on_.clear();
}

void Score::add(const Score& other) {
  true_positives_ += other.true_positives_;
  false_positives_ += other.false_positives_;
  true_negatives_ += other.true_negatives_;
  false_negatives_ += other.false_negatives_;
  delays_.insert(delays_.end(), other.delays_.begin(), other.delays_.end());
  never_seen_ += other.never_seen_;
}

double Score::mean_delay() const {
  return delays_.empty() ? 0
                         : std::accumulate(delays_.begin(), delays_.end(), 0.0) / static_cast<double>(delays_.size());
}

}  // namespace lodestone
