// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/motion/game_motion.h"

#include <fmt/format.h>

#include <utility>

#include "lodestone/mesh/errors.h"

namespace lodestone {

Motion motion_of(std::shared_ptr<const Game_model> model) {
  const auto pose = [model](std::size_t frame, std::span<Point> positions) {
    if (frame >= model->frames)
      throw Bad_motion(fmt::format("{}: frame {} (counted from 0) is requested, the model has {}", model->name, frame,
                                   model->frames));
    if (positions.size() != model->vertices)
      throw Bad_motion(fmt::format("{}: positions of {} vertices are requested, the model has {}", model->name,
                                   positions.size(), model->vertices));
    pose_game_model(*model, frame, positions);
  };
  return {.frames = model->frames, .pose = pose, .joined = model->joined};
}

Motion read_game_motion(const std::filesystem::path& file, std::size_t vertices, const Mesh_file_options& limits) {
  std::shared_ptr<const Game_model> model;
  try {
    model = read_game_model(file, limits);
  } catch (const Bad_mesh& error) {
    throw Bad_motion(error.what());
  }
  if (model->vertices != vertices)
    throw Bad_motion(fmt::format("{}: the model has {} vertices, expected {}", model->name, model->vertices, vertices));
  return motion_of(std::move(model));
}

}  // namespace lodestone
