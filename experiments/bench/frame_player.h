// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "lodestone/io/scenes/scene_file.h"

namespace lodestone {

/// A scene that is read once. Its frames are played forwards and backwards in turn, so that the motion stays smooth.
class Frame_player {
 public:
  explicit Frame_player(const std::string& name)
      : scene_(read_scene(std::string(LODESTONE_SCENES) + "/" + name + ".json")) {}

  Scene& scene() { return scene_; }
  void next() {
    for (auto& object : scene_.objects) pose(object, frame_);
    if (frame_ + 1 == scene_.frames) forward_ = false;
    if (frame_ == 0) forward_ = true;
    frame_ += forward_ ? 1 : std::size_t(-1);
  }

 private:
  Scene scene_;
  std::size_t frame_ = 0;
  bool forward_ = true;
};

}  // namespace lodestone
