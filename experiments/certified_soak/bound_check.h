// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "certified_soak/random_body.h"
#include "lodestone/tree/tree_surface.h"

namespace lodestone {

/// Compares the boxes that a bound gives to all nodes of a tree with all vertices below, in each pose.
class Bound_check {
 public:
  struct Count {
    std::size_t boxes = 0;    ///< compared
    std::size_t outside = 0;  ///< of these: with a vertex outside
    std::size_t refused = 0;  ///< times that the bound was shown what it had promised, and said no
  };

  /// @param body  in the pose that is taken for rest; must outlive this
  Bound_check(const Random_body& body, std::size_t leaf_faces);
  Bound_check(const Bound_check&) = delete;
  Bound_check& operator=(const Bound_check&) = delete;

  /// Compares all boxes of the present pose, and once more where the body is placed. Then shows the bound some of the
  /// leaves, as if they had been read.
  Count check(Random& random);

 private:
  template <class Placed>
  void compare(Count& count, const Placed& placed) const;

  const Random_body& body_;
  std::vector<Corners> corners_;
  std::vector<double> rest_, now_;  ///< 3 V
  Tree_surface surface_;
  std::unique_ptr<Node_bound> bound_;
  std::vector<Aabb> fitted_;  ///< per node: around its vertices, exactly
};

}  // namespace lodestone
