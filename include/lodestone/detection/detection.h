// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lodestone/detection/collision_filter.h"
#include "lodestone/detection/detector_options.h"
#include "lodestone/detection/frame.h"
#include "lodestone/detection/watched_mesh.h"
#include "lodestone/mesh/rigid_motion.h"
#include "lodestone/mesh/saved_state.h"

namespace lodestone {

/// What a Detector asks of a mode. The models own the objects. The caller checks ids: none is that of a removed object.
///
/// What only one model can answer is no part of this interface: the Detector asks that model itself. A new mode is one
/// more model, which `make_detection` makes. `detector_options.h` and its source name the mode and check its options.
/// The program and the Python package have what `grep Mode::` finds there.
class Detection {
 public:
  virtual ~Detection() = default;

  /// Adds an object, whose id is the number of objects added before.
  /// @throws Bad_mesh, Bad_argument  nothing has been added
  virtual void add(const Watch_mesh& watch, const Object_options& options) = 0;
  /// The mesh of an object. Its maps, if it has any, are up to date from the next partition on.
  virtual Watched_mesh& mesh(Object_id object) = 0;

  /// Takes note that the vertices of an object have moved.
  virtual void update(Object_id object) = 0;
  /// Places an object elsewhere from now on; none: where its mesh is.
  virtual void place(Object_id object, const std::optional<Rigid_motion>& placement) = 0;
  /// Reads the faces of an object's mesh again.
  /// @throws Bad_mesh, Bad_argument  the object stays as it was
  virtual void rebuild(Object_id object, std::span<const std::uint32_t> file_vertex) = 0;
  /// The same where it is known which faces have changed. A mode need not make use of that.
  virtual void rebuild(Object_id object, const Changed_faces& /*changed*/) {
    rebuild(object, std::span<const std::uint32_t>());
  }

  /// Writes what has been built of an object, which is built first if it has not been.
  /// @throws Bad_mesh, Bad_argument  as `detect`
  virtual void save(Object_id object, State_writer& state) = 0;
  /// Takes what `save` has written of an object with the same faces, in place of building it.
  /// @throws Bad_saved_object  the object stays as it was
  virtual void load(Object_id object, State_reader& state) = 0;

  /// V: the region of each vertex of an object, 0 where it has no regions. Empty before it has been built.
  virtual std::vector<Region_index> labels(Object_id object) const = 0;

  /// Forgets an object, and refers to its mesh no more.
  /// @throws Bad_argument  a visitor is being shown face pairs; the object stays
  virtual void remove(Object_id object) = 0;

  /// Finds the collisions between all objects where their vertices are now.
  /// @param filter  lets no pair of a removed object pass
  /// @return valid until the next call
  virtual const Frame& detect(const Collision_filter& filter) = 0;
};

}  // namespace lodestone
