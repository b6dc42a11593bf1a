// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "lodestone/io/formats/joined_vertices.h"
#include "lodestone/io/formats/mesh_file_options.h"
#include "lodestone/mesh/concepts.h"

namespace lodestone {

class Computed_motion;

/// Frames per second of a motion whose file tells no rate, nor the caller.
inline constexpr double usual_rate = 30;

/// The animations of a file, of which a motion plays one.
struct File_animations {
  std::vector<std::string> names = {};  ///< of all, in the order of the file; equal or empty names are possible
  std::size_t played = 0;               ///< the index of the one that is played
  bool is_chosen = false;               ///< a scene says which one; else it is the first, or the caller's choice
};

/// How the vertices of one object move: a function from the frame index to all positions.
struct Motion {
  std::size_t frames = 0;  ///< number of frames; 0: unlimited

  /// Writes the positions of `frame` (counted from 0), one per vertex of the object's file or shape, in that order.
  /// @throws Bad_motion  the frame is broken or past the end
  std::function<void(std::size_t frame, std::span<Point> positions)> pose;

  double frames_per_second = 0;  ///< 0: the frames have no times
  double start = 0;              ///< time of the first frame in seconds, if they have
  /// The same motion at another rate, > 0, from another time on, in seconds, if its reader chose the rate; empty if the
  /// caller did, or there is none.
  std::function<Motion(double frames_per_second, double start)> resampled = {};
  /// The same motion of some vertices, as one whose frames need not be posed as a whole; empty: `pose` must be used.
  /// @param vertices  their indices, in the order of the file or shape
  std::function<std::unique_ptr<Computed_motion>(std::span<const std::uint32_t> vertices)> computed = {};
  Joined_vertices joined = {};                    ///< of its glTF or MD3 file, or else of the mesh that it moves
  File_animations animations = {};                ///< of a glTF file; no names in other formats
  std::vector<std::filesystem::path> files = {};  ///< of a glTF file: those that it is read from
  std::set<std::string> ignored_extensions = {};  ///< of a glTF file: as in Mesh_file
};

/// Motion from a point cache in the PC2 format (Blender, 3ds Max, Maya). `pose` reads each frame on demand, and several
/// threads may call it at once.
/// @param vertices  number of vertices the cache must have
/// @throws Bad_motion  not a PC2 file, a wrong number of vertices, shorter than its header says; from `pose`: a
///                     non-finite coordinate
Motion read_point_cache(const std::filesystem::path& file, std::size_t vertices);

/// The same from a point cache in the MDD format (LightWave, Blender, Houdini). The format has no signature, so the
/// file's size must be exactly what its header implies. The times of the first and the last frame give the rate and the
/// start, if the last is later; the others are ignored.
Motion read_mdd_cache(const std::filesystem::path& file, std::size_t vertices);

/// Motion from the frames of a game model, MD2 or MD3. The file is kept in memory.
/// @param vertices  number of vertices the model must have
/// @param limits    of the file
/// @throws Bad_motion  a broken file, a wrong number of vertices; from `pose`: a non-finite coordinate
Motion read_game_motion(const std::filesystem::path& file, std::size_t vertices, const Mesh_file_options& limits = {});

/// Motion from one mesh file per frame, all with the same faces. The first file is read at once, for its faces; `pose`
/// reads the file of each frame on demand. Any format of `read_mesh`; positions come in file order.
/// @param vertices  number of vertices each file must have
/// @param limits    of each file, and of the number of files
/// @throws Bad_motion  no file, too many files, a file that does not exist, a broken first file; from `pose`: a broken
///                     file, a wrong number of vertices, faces that differ from those of the first file
Motion read_mesh_sequence(std::vector<std::filesystem::path> files, std::size_t vertices,
                          const Mesh_file_options& limits = {});

/// Options of `read_gltf_motion`.
struct Gltf_motion_options {
  /// Sampling rate, > 0. Not given: one frame per key, from the first on, if the keys of all curves follow each other
  /// at equal distances, up to rounding, and there are at least 5 per second; else 30.
  std::optional<double> frames_per_second = {};
  double start = 0;  ///< time of the first frame in seconds; of no meaning without `frames_per_second`
  /// Which animation of the file: its index or its name.
  std::variant<std::size_t, std::string> animation = std::size_t{0};
  Mesh_file_options limits = {};  ///< of the file, its meshes and its frames
};

/// Motion from an animation of a glTF 2.0 file (.gltf, .glb): nodes, skins and morph targets. Frame t is sampled at
/// start + t / frames_per_second seconds, or at key t; the last frame is the last at or before the animation's end. The
/// file is kept in memory, and `pose` computes frames on demand. Vertices have the indices that `read_mesh` gives those
/// of the file.
/// @param vertices  number of vertices the file must have
/// @throws Bad_motion    a broken file, a wrong number of vertices, no such animation, more frames than `limits` allow
/// @throws Bad_argument  the frame rate is not positive and finite
Motion read_gltf_motion(const std::filesystem::path& file, std::size_t vertices,
                        const Gltf_motion_options& options = {});

}  // namespace lodestone
