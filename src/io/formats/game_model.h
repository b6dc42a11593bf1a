// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lodestone/io/formats/mesh_file_options.h"
#include "lodestone/mesh/mesh_numbering.h"

/// Key-framed models of games: MD2 (Quake II) and MD3 (Quake III). A file is triangles, and where all vertices are in
/// each frame, in fixed point.
namespace lodestone {

/// Vertices of one surface of a file.
struct Game_surface {
  std::size_t vertices = 0;
  std::size_t first_frame = 0;  ///< byte of the first frame's vertices
  std::size_t frame_bytes = 0;  ///< from one frame to the next
};

struct Game_model {
  std::string name = {};   ///< of the file
  std::string bytes = {};  ///< all of it
  bool is_md2 = false;
  std::size_t frames = 0;
  std::size_t vertices = 0;
  std::vector<Game_surface> surfaces = {};
  std::vector<Corners> faces = {};  ///< vertices that are the same in every frame are named by one number
};

/// By the file's extension.
bool is_game_model(const std::filesystem::path& file);

/// @throws Bad_mesh
std::shared_ptr<const Game_model> read_game_model(const std::filesystem::path& file,
                                                  const Mesh_file_options& options = {});

/// @throws Bad_motion  a coordinate that is not finite
void pose_game_model(const Game_model& model, std::size_t frame, std::span<Point> positions);

}  // namespace lodestone
