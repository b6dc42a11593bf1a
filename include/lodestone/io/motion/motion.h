// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "lodestone/mesh/concepts.h"

namespace lodestone {

/// How the vertices of one object move: a function from the frame number to all positions.
struct Motion {
  std::size_t frames = 0;  ///< number of frames it holds; 0: any number

  /// Writes the positions of `frame` (counted from 0), one per vertex of the object's file or shape, in that order.
  /// @throws Bad_motion when the frame is broken or past the end
  std::function<void(std::size_t frame, std::span<Point> positions)> pose;
};

/// Motion from a point cache in the PC2 format (Blender, 3ds Max, Maya). Frames are read one by one, as asked for;
/// several threads may ask at once.
/// @param vertices  number of vertices the cache must have
/// @throws Bad_motion  not a PC2 file, another number of vertices, shorter than its header says; when a frame is
///                     read: a non-finite coordinate
Motion read_point_cache(const std::filesystem::path& file, std::size_t vertices);

/// The same from a point cache in the MDD format (LightWave, Blender, Houdini). It has no signature: the size of the
/// file must be exactly what its header asks for. The times of the frames are not used.
Motion read_mdd_cache(const std::filesystem::path& file, std::size_t vertices);

/// Motion from the frames of a game model, MD2 or MD3. The file is kept in memory.
/// @param vertices  number of vertices the model must have
/// @throws Bad_motion  a broken file, another number of vertices; when a frame is read: a non-finite coordinate
Motion read_game_motion(const std::filesystem::path& file, std::size_t vertices);

/// Motion from one mesh file per frame, all with the same faces. The first is read at once, for its faces; each file is
/// read when its frame is asked for. Any format of `read_mesh`; positions come in file order.
/// @param vertices  number of vertices each file must have
/// @throws Bad_motion  no file, a file that does not exist, a broken first one; when a frame is read: a broken file,
///                     another number of vertices or other faces than the first
Motion read_mesh_sequence(std::vector<std::filesystem::path> files, std::size_t vertices);

struct Gltf_motion_options {
  double frames_per_second = 30;  ///< at which the animation is sampled; > 0
  /// Which animation of the file: its number from 0, or its name.
  std::variant<std::size_t, std::string> animation = std::size_t{0};
};

/// Motion from an animation of a glTF 2.0 file (.gltf, .glb): nodes, skins and morph targets. Frame t is the moment
/// t / frames_per_second; the last frame is the last before the animation's end, or at it. The file is kept in memory,
/// frames are computed as asked for. Vertices come as `read_mesh` numbers those of the file.
/// @param vertices  number of vertices the file must have
/// @throws Bad_motion    a broken file, another number of vertices, no such animation, more than a million frames
/// @throws Bad_argument  no frame rate
Motion read_gltf_motion(const std::filesystem::path& file, std::size_t vertices,
                        const Gltf_motion_options& options = {});

}  // namespace lodestone
