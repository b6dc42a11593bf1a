// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lodestone/filter/face_candidate.h"
#include "lodestone/mesh/coordinates.h"
#include "lodestone/mesh/mesh_numbering.h"
#include "lodestone/volumes/aabb.h"
#include "lodestone/volumes/leaf_faces.h"

namespace lodestone {

struct Face_columns;
struct Filter_scratch;
namespace kernel {
struct Filter_request;
}  // namespace kernel

/// Group against group: a Face_filter for faces of two meshes that are in no tree. Nothing is prepared for a group and
/// nothing is kept of it, so groups can be put together as needed.
///
/// Holds the memory that it needs, so each thread needs its own.
class Face_group_filter {
 public:
  /// Has no positions yet: see `begin`.
  Face_group_filter();
  ~Face_group_filter();
  Face_group_filter(const Face_group_filter&) = delete;
  Face_group_filter& operator=(const Face_group_filter&) = delete;

  /// Sets the positions of the two meshes.
  /// @param bounds_a, bounds_b  enclose all faces of the groups
  void begin(Coordinates a, const Aabb& bounds_a, Coordinates b, const Aabb& bounds_b);

  /// The face pairs of two groups that are not proven apart, as `Face_filter::face_candidates`.
  ///
  /// O(n + m + n m / lanes) for groups of n and m faces.
  /// @param a, b  1 to `most_leaf_faces` faces each
  /// @return valid until the next call
  std::span<const Face_candidate> face_candidates(std::span<const Corners> a, std::span<const Corners> b);

 private:
  struct Side;

  std::unique_ptr<Side> sides_[2];
  std::unique_ptr<kernel::Filter_request> request_;
  std::unique_ptr<Filter_scratch> scratch_;
  std::vector<Face_candidate> candidates_;
};

}  // namespace lodestone
