// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "lodestone/detection/collision_groups.h"
#include "lodestone/io/formats/file_part.h"
#include "lodestone/io/motion/motion.h"
#include "lodestone/mesh/concepts.h"
#include "lodestone/mesh/pairs.h"

namespace lodestone {

/// A mesh, its motion, and what an experiment needs to know about it.
struct Scene_object {
  std::string name;                               ///< unique in its scene
  Surface_mesh mesh;                              ///< at rest, until `pose` moves it
  std::vector<std::uint32_t> file_vertex;         ///< per mesh vertex: its index in the positions of `motion`
  std::size_t file_vertices = 0;                  ///< number of those positions
  std::vector<std::uint32_t> file_face;           ///< per mesh face: its face in the file, as in Mesh_file
  File_parts parts = {};                          ///< that the mesh's file names
  std::set<std::string> ignored_extensions = {};  ///< as in Mesh_file
  Motion motion;                                  ///< also set for an object that never moves
  std::size_t particles = 0;                      ///< 0: automatic
  Collision_groups collision = {};                ///< a bit per name of a group

  /// Where the particles of the predecessor start: only on the part of the surface farthest in this direction.
  std::optional<Kernel::Vector_3> scattered_side;

  std::vector<std::filesystem::path> files;  ///< that the mesh and its motion are read from; some may be patterns
};

/// Objects that move, as a file describes them.
struct Scene {
  std::string name;                   ///< as the file says, else the name of the file without extension
  std::string description;            ///< plain text; may be empty
  std::size_t frames = 1;             ///< how long the motion lasts
  std::vector<Scene_object> objects;  ///< in the order of the file
  std::vector<Object_pair> ignored;   ///< object pairs to skip, a <= b, sorted; a = b: self-collisions of an object

  /// Whether a pair is skipped: it is listed, or one of its objects does not meet the other.
  /// @param pair  a <= b
  bool ignores(Object_pair pair) const {
    return !meet(objects[pair.a].collision, objects[pair.b].collision) || std::ranges::binary_search(ignored, pair);
  }
};

/// Options of `read_scene`.
struct Scene_options {
  bool allow_outside = false;                 ///< whether the scene may name files outside its folder
  Mesh_file_options limits = {};              ///< of every file with faces that it names; of the frames of the scene
  std::size_t max_objects = 10'000;           ///< scenes of more objects are refused
  std::size_t max_scene_faces = 500'000'000;  ///< so are scenes whose objects have more faces together
};

/// Reads a scene: JSON as described by docs/scene.schema.json.
///
/// Meshes are read or made at once; `pose` reads frames of point caches and mesh sequences on demand. Paths are
/// relative to the scene's folder; a path that leaves it is refused unless `allow_outside`.
///
/// @throws Bad_scene  a violation of the schema, with a JSON pointer, such as
///                    `scene.json: /objects/1/motion: unknown key "pc" (expected one of pc2, mdd, gltf, keyframes,
///                    sequence, deform)`; a syntax error, with line and column; more objects, faces or frames than
///                    the options allow
/// @throws Bad_mesh, Bad_motion  a file that the scene names is missing or broken
Scene read_scene(const std::filesystem::path& file, const Scene_options& options = {});

/// Moves the object's mesh to its positions in `frame`, counted from 0.
/// @throws Bad_motion  a non-finite coordinate, a broken frame, a frame past the end; the mesh is then unchanged
void pose(Scene_object& object, std::size_t frame);

}  // namespace lodestone
