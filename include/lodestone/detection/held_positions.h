// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

namespace lodestone {

/// Counts the promises that positions stay as they are, and numbers the times in which there is one.
class Position_hold {
 public:
  /// A promise is made.
  void begin() {
    if (promises_++ == 0) ++number_;
  }
  /// A promise ends.
  void end() { --promises_; }
  /// The number of the time in which there is a promise; 0: there is none now.
  std::uint64_t number() const { return promises_ > 0 ? number_ : 0; }

 private:
  std::size_t promises_ = 0;
  std::uint64_t number_ = 0;
};

/// The promise, as long as this lives, that no vertex of a detector's meshes moves: see `Detector::hold_positions`. It
/// may outlive the detector. Until then its end counts as a use of the detector, by one thread at a time.
class [[nodiscard]] Held_positions {
 public:
  /// @param hold  not null
  explicit Held_positions(std::shared_ptr<Position_hold> hold) : hold_(std::move(hold)) { hold_->begin(); }
  ~Held_positions() {
    if (hold_) hold_->end();
  }
  /// The promise goes over to this.
  Held_positions(Held_positions&& other) = default;
  Held_positions& operator=(Held_positions&&) = delete;

 private:
  std::shared_ptr<Position_hold> hold_;  ///< null: another has the promise
};

}  // namespace lodestone
