// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "lodestone/bounds/node_bound.h"
#include "lodestone/mesh/concepts.h"
#include "lodestone/mesh/position_source.h"
#include "lodestone/mesh/skinned_points.h"

namespace lodestone {

/// A motion whose frames need not be posed as a whole: its positions are computed one by one, with the same bits, and
/// it tells where they can be. A model of Computed_points and of Motion_promise, so mode `certified` reads from it only
/// what is near. As a model of Computed_points it writes all positions to the memory given to `pose_all`.
class Computed_motion : public Position_source {
 public:
  /// Changes the pose.
  /// @throws Bad_motion  the frame is broken or past the end; the pose is then undefined
  virtual void set_frame(std::size_t frame) = 0;
  /// Where the vertices of each node can be.
  virtual Any_bound bound(const Bounded_object& object) const = 0;
  /// The joints and morph targets that move the vertices; null: something else does.
  virtual const Skinned_points* skin() const { return nullptr; }
};

/// A motion that is taken elsewhere by an affine transformation.
std::unique_ptr<Computed_motion> placed(std::unique_ptr<Computed_motion> motion,
                                        const Kernel::Aff_transformation_3& placement);

/// A motion that keeps its pose from a frame on.
std::unique_ptr<Computed_motion> held(std::unique_ptr<Computed_motion> motion, std::size_t last_frame);

}  // namespace lodestone
