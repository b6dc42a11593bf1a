// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>

#include "lodestone/mesh/errors.h"

namespace lodestone {

/// Marks a mode as busy while it lives: what it reads and keeps must not change until the answer is there. So functions
/// of the user's that it calls must not call it: visitors, point maps, strategies, promises.
class Busy {
 public:
  /// @param flag           of the mode; must outlive this
  /// @throws Bad_argument  as `check`
  explicit Busy(bool& flag) : flag_(&flag) {
    check(flag);
    flag = true;
  }
  /// The mode stays busy as long as this lives.
  Busy(Busy&& other) noexcept : flag_(std::exchange(other.flag_, nullptr)) {}
  Busy& operator=(Busy&&) = delete;
  ~Busy() {
    if (flag_ != nullptr) *flag_ = false;
  }

  /// @throws Bad_argument  the mode is busy
  static void check(bool flag) {
    if (flag)
      throw Bad_argument(
          "a function that the detector calls (a visitor, a point map, a strategy, a promise) must not call it");
  }

 private:
  bool* flag_;  ///< null: moved from
};

}  // namespace lodestone
