// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "certified/character_scene.h"
#include "lodestone/mesh/pairs.h"

/// Ways to ask whether two characters collide, posing included.
namespace lodestone {

/// One way, for the two characters of one scene. Their points are in the pose to ask about; nothing else has moved yet.
class Rival {
 public:
  Rival() = default;
  Rival(const Rival&) = delete;
  Rival& operator=(const Rival&) = delete;
  virtual ~Rival() = default;

  /// @return whether the two collide; none: the query gave up
  virtual std::optional<bool> any() = 0;
  /// @param found  every face pair that intersects is added, in any order
  /// @return false: the query gave up
  virtual bool all(std::vector<Face_pair>& found) = 0;
};

struct Rival_kind {
  std::string name;
  bool lists_pairs = true;         ///< false: `all` is never called
  bool is_library = false;         ///< not part of Lodestone
  std::size_t most_triangles = 0;  ///< of both together; beyond, it does not take part. 0: always
  std::function<std::unique_ptr<Rival>(Character_scene&)> make = nullptr;
};

/// The first is mode `certified`, the second poses everything and asks mode `exact`.
std::vector<Rival_kind> rival_kinds();

/// The other libraries that were fastest in the experiment `peers`, each after posing everything; none if they are not
/// built.
std::vector<Rival_kind> library_kinds();

/// Writes all positions of the current pose into the meshes.
void pose_meshes(Character_scene& scene);

}  // namespace lodestone
