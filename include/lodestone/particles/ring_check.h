// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/pairs.h"
#include "lodestone/particles/meeting.h"

namespace lodestone {

/// Exact confirmation of a meeting: tests the faces around the two vertices, ring by ring outwards, until two
/// intersect. Keeps its memory from one check to the next.
class Ring_check {
 public:
  /// Most faces on a side that are tested. Around a vertex with more, such as the tip of a cone, testing all against
  /// all would take longer than any other search.
  static constexpr std::size_t most_faces = 512;

  /// Tests the faces with a corner less than `rings` hops from either vertex. Ends before a ring with which one side
  /// could have more than `most_faces`.
  /// @param found  receives one contact, if there is one among those faces
  /// @return whether there is
  /// @throws Bad_mesh  a coordinate that is read is not finite
  bool check(const Walked_surface& a, const Walked_surface& b, Meeting at, std::size_t rings, Face_pair& found);

  /// Face pairs that went to the exact test since `reset_counts`.
  std::size_t exact_tests() const { return exact_tests_; }
  /// Positions read since `reset_counts`, some more than once.
  std::size_t vertices_read() const { return vertices_read_; }
  /// Sets both counts to 0.
  void reset_counts() { exact_tests_ = vertices_read_ = 0; }

 private:
  /// The faces around one of the two vertices, ring after ring.
  struct Rings {
    std::vector<Read_face> faces;
    std::vector<std::uint32_t> vertices;  ///< all of the rings so far
    std::vector<std::uint32_t> fresh;     ///< those of the last ring
    std::vector<std::uint32_t> rim;       ///< memory: those of the next
  };

  void start(Rings& rings, std::uint32_t vertex);
  static bool is_small_enough(const Walked_surface& surface, const Rings& rings);
  void grow(const Walked_surface& surface, Rings& rings);
  bool test(std::span<const Read_face> faces_a, std::span<const Read_face> faces_b, Face_pair& found);

  Rings a_, b_;
  std::size_t exact_tests_ = 0, vertices_read_ = 0;
};

}  // namespace lodestone
