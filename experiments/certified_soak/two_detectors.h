// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "certified_soak/random_body.h"
#include "lodestone/detector.h"

namespace lodestone {

/// Whether an answer about a pair is what mode `exact` says, and lists as many of its contacts as were asked for.
/// @param truth  lists all contacts
/// @param asked  of `found`
bool is_right(const Frame& found, const Frame& truth, Object_pair pair, const Detector_options& asked);

/// The modes `certified` and `exact` on the same bodies.
class Two_detectors {
 public:
  /// @param options  of both, but that mode `exact` lists all contacts: those that mode `certified` lists must be among
  ///                 them
  explicit Two_detectors(const Detector_options& options);

  void add(const Random_body& body);
  Detector<>& certified() { return certified_; }
  /// Calls `act(detector)` for both.
  void both(const auto& act) {
    act(certified_);
    act(exact_);
  }

  struct Frame_check {
    std::vector<bool> meets_first;  ///< per body: whether it collides with the first
    bool collides = false;          ///< two of them do
    bool same = true;               ///< both modes give the same answers
  };
  /// Plays a frame in both.
  Frame_check detect();
  /// Asks both a question, and compares what they answer.
  bool agree(const auto& ask) { return ask(certified_) == ask(exact_); }
  /// Broken bounds that the last frame and the questions since have come upon.
  std::size_t violations() const;

 private:
  Detector_options asked_;
  Detector<> certified_, exact_;
  Object_id count_ = 0;
};

}  // namespace lodestone
