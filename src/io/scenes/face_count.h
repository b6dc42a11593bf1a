// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "lodestone/io/scenes/scene_file.h"

namespace lodestone::detail {

/// The faces of the objects of a scene together, counted while they are read.
class Face_count {
 public:
  explicit Face_count(std::size_t most) : most_(most) {}

  /// @return what is wrong, if there are more faces now than are allowed
  std::optional<std::string> add(const Scene_object& object);

 private:
  std::size_t most_;
  std::size_t count_ = 0;
};

}  // namespace lodestone::detail
