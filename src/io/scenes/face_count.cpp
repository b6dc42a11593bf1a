// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scenes/face_count.h"

#include <fmt/format.h>

namespace lodestone::detail {

std::optional<std::string> Face_count::add(const Scene_object& object) {
  count_ += object.mesh.number_of_faces();
  if (count_ <= most_) return std::nullopt;
  return fmt::format("the objects up to this one have {} faces together, where at most {} are allowed", count_, most_);
}

}  // namespace lodestone::detail
