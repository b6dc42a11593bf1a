// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "lodestone/mesh/pairs.h"
#include "lodestone/mesh/patch.h"

namespace lodestone {

/// Exact confirmation of candidate pairs. Holds the memory that it needs, so that a frame allocates nothing once it has
/// met its largest patches.
class Confirmation {
 public:
  /// Room for patches of so many faces and vertices.
  void reserve(std::size_t faces, std::size_t vertices);

  /// Adds the intersecting face pairs of two posed patches to `found`; with a query other than `all`, stops at one.
  ///
  /// Vertices outside the overlap of the two boxes rule out faces, a sweep along its longest axis rules out pairs, and
  /// `triangles_intersect` decides the rest. O(n + m) for patches that do not come near each other,
  /// O(n + m + s log s + pairs that overlap along the axis) for the s faces within the overlap; all n m pairs at worst.
  ///
  /// @return whether a pair was found
  bool confirm(const Posed_patch& a, const Posed_patch& b, Contact_query query, std::vector<Face_pair>& found);

  /// Face pairs that went to the exact test since `reset_count`.
  std::size_t exact_tests() const { return exact_tests_; }
  void reset_count() { exact_tests_ = 0; }

 private:
  struct Boxed_face {
    Box box;
    std::uint32_t place;  ///< in the lists of the patch
  };

  void faces_within(const Posed_patch& posed, const Box& overlap, std::vector<Boxed_face>& faces);

  std::vector<std::uint8_t> outcodes_;
  std::vector<Boxed_face> faces_a_, faces_b_;
  std::size_t exact_tests_ = 0;
};

}  // namespace lodestone
