// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lodestone/bounds/motion_bound.h"
#include "lodestone/bounds/node_bound.h"
#include "lodestone/volumes/aabb.h"

namespace lodestone {

class Displacement_promise;

/// Boxes from a Displacement_promise: the last box of a node, grown by what has been promised since. Reads no
/// positions. A model of All_watching_bound.
///
/// A leaf that has been read has the box fitted to it. The boxes above it are then those around their children's grown
/// ones, up to where nothing changes. So boxes are tight where surfaces are read, and at first everywhere.
///
/// *Rounding.* Totals of distances are rounded upwards, and so is what they have grown by. Without a frame, boxes that
/// have not grown are the fitted ones; others are moved outwards by one double, since rounding is at most half of that.
/// In a frame let R and t be rotation and translation, u = 2^-53, and let a position p = R q + t be rounded up to 16
/// times per term, of which Eigen's `frame * q` needs 4.
///
/// - To the world: along an axis, the ends of R [low, high] + t are sums of four terms, rounded up to 4 times each. Let
///   m = sum_j |R_ij| max(|low_j|, |high_j|) + |t_i|. The ends and p differ from the exact values by at most 20 u m.
///   The ends are moved outwards by 32 u m, which covers its own rounding, and by 2^-1070 for products that underflow.
/// - To the frame: with s = p - t, the exact R^T s differs from q by (R^T R - I) q, and by R^T times the rounding of p,
///   which is at most 16 u (1.8 |q| + |t|). Rounding s and R^T s adds 5 u |s|. With d >= |R^T R - I|, which is at most
///   10^-5, and |q| <= 1.01 (|s| + 17 u |t|), all this is at most (1.01 d + 36 u) |s| + 18 u |t|. The ends are moved
///   outwards by (2 d + 64 u) |s| + 64 u |t|, with sums of magnitudes for |s| and |t|, and by 2^-1070. So are those of
///   a box that is turned, with the greatest magnitudes in the box: an end is a sum of three products like R^T s.
class Displacement_bound {
 public:
  /// O(V).
  /// @param promise        must outlive this, as must the object's layout
  /// @throws Bad_argument  `object` has other vertices than its positions; rest or labels have the wrong length; the
  ///                       promise tells regions apart, and a label is of none of them
  Displacement_bound(const Displacement_promise& promise, const Bounded_object& object);

  /// Number of nodes of the tree.
  std::size_t node_count() const { return last_.size(); }
  /// The box of a node in the current pose. O(1).
  Aabb box(std::uint32_t node) const;
  /// Takes the box of a leaf that has been read. O(vertices of the leaf) unless the frame is the identity, and
  /// O(log N) for N nodes.
  /// @return true: whether a leaf lies in its box is seen without this
  bool note_read(std::uint32_t leaf, const Aabb& fitted, Coordinates coordinates);
  /// Takes the boxes of all nodes. O(N). In a frame a leaf has the box around its fitted one, turned.
  /// @return true, as `note_read`
  bool note_all(std::span<const Aabb> fitted, Coordinates coordinates, bool all);

 private:
  /// What is known of a node.
  struct Last_box {
    Aabb box;      ///< in the rigid frame
    double total;  ///< what had been promised when it was found
  };
  double total(std::uint32_t node) const;
  Aabb now(std::uint32_t node) const;
  Aabb in_frame(std::uint32_t leaf, const Aabb& fitted, Coordinates coordinates) const;
  Aabb around_children(std::uint32_t node) const;

  const Displacement_promise* promise_;
  const Tree_layout* layout_;
  std::vector<Last_box> last_;          ///< per node
  std::vector<std::uint32_t> parents_;  ///< per node; the root's is itself
  std::vector<Region_index> regions_;   ///< per node; `several_regions` where they differ
};

/// A promise: how far a vertex can have moved since the promise was last changed. A model of Motion_promise.
///
/// The caller says so with `move`, before a query asks about the new positions. Distances add up. What was said before
/// a bound was made does not count for it: its first boxes are around the vertices where they are then.
///
/// A rigid frame takes large motions out of the promise. With a frame, a vertex is at p = frame * q, and it is q that
/// moves by no more than the distance. A body that spins has a frame that spins, and distance 0 if it does not deform.
/// Frames are the identity until `move` gives another; it stays until the next is given.
///
/// Without a frame the promise is about positions as they are computed. With one, it is about q, and p may be rounded
/// as `frame * q` is.
class Displacement_promise {
 public:
  /// @param regions        how many regions `move` tells apart: as many as the object has, which can be more than were
  ///                       asked for where its surface has several components; 1: labels do not matter
  /// @throws Bad_argument  there are none
  explicit Displacement_promise(std::size_t regions = 1);
  Displacement_promise(const Displacement_promise&) = delete;
  Displacement_promise& operator=(const Displacement_promise&) = delete;

  /// No vertex has moved farther than this since the last call. O(regions), as are the others.
  /// @param distance       in units of the coordinates; finite, >= 0
  /// @throws Bad_argument  `distance` is out of range; the promise stays as it was
  void move(double distance);
  /// The same in a rigid frame.
  /// @param frame          the rigid frame from now on
  /// @throws Bad_argument  `frame` is not rigid, see Rigid_motion
  void move(double distance, const Eigen::Isometry3d& frame);
  /// No vertex of region i has moved farther than `per_region[i]`. Vertices of several regions together can have moved
  /// by the largest.
  /// @throws Bad_argument  there is not one distance for each region, or one is out of range; the promise stays as it
  ///                       was
  void move(std::span<const double> per_region);
  /// Both: distances by region, in a rigid frame.
  /// @throws Bad_argument  as the two calls above
  void move(std::span<const double> per_region, const Eigen::Isometry3d& frame);

  /// Number of regions that `move` tells apart.
  std::size_t region_count() const { return totals_.size(); }
  /// All that has been promised for a region, rounded upwards; `several_regions`: for vertices of any.
  double total(Region_index region) const;

  /// The bound for one object, which this must outlive. O(V).
  Displacement_bound bound(const Bounded_object& object) const { return {*this, object}; }

 private:
  friend class Displacement_bound;

  /// A frame that is not the identity.
  struct Rigid_frame {
    Eigen::Matrix3d rotation;
    Eigen::Vector3d translation;
    double defect;  ///< an upper bound of |R^T R - I|

    Aabb to_world(const Aabb& box) const;
    /// The box of a leaf's vertices.
    Aabb to_frame(std::span<const std::uint32_t> vertices, Coordinates coordinates) const;
    /// A box of all that is in a box, which is finite.
    Aabb to_frame(const Aabb& box) const;
    double margin_to_frame(double farthest) const;
  };
  static std::optional<Rigid_frame> checked(const Eigen::Isometry3d& frame);
  void check(std::span<const double> per_region) const;

  std::vector<double> totals_;  ///< per region
  double largest_total_ = 0;    ///< of the largest distances
  std::optional<Rigid_frame> frame_;
};

}  // namespace lodestone
