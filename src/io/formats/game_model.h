// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lodestone/io/formats/joined_vertices.h"
#include "lodestone/io/formats/mesh_file_options.h"
#include "lodestone/mesh/mesh_numbering.h"

/// Key-framed game models: MD2 (Quake II) and MD3 (Quake III). A file has triangles and the positions of all vertices
/// in each frame, in fixed point.
namespace lodestone {

/// The vertices of one surface in a file.
struct Game_surface {
  std::size_t vertices = 0;
  std::size_t first_frame = 0;  ///< byte offset of the first frame's vertices
  std::size_t frame_bytes = 0;  ///< stride from one frame to the next
};

struct Game_model {
  std::string name = {};   ///< of the file
  std::string bytes = {};  ///< the whole file
  bool is_md2 = false;
  std::size_t frames = 0;
  std::size_t vertices = 0;
  std::vector<Game_surface> surfaces = {};
  std::vector<Corners> faces = {};
  Joined_vertices joined = {};  ///< those that coincide in every frame
};

/// Whether the file's extension is that of a game model.
bool is_game_model(const std::filesystem::path& file);

/// @throws Bad_mesh
std::shared_ptr<const Game_model> read_game_model(const std::filesystem::path& file,
                                                  const Mesh_file_options& options = {});

/// @throws Bad_motion  a coordinate that is not finite
void pose_game_model(const Game_model& model, std::size_t frame, std::span<Point> positions);

}  // namespace lodestone
