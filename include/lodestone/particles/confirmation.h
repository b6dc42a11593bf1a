// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lodestone/mesh/pairs.h"
#include "lodestone/mesh/patch.h"
#include "lodestone/mesh/unset_vector.h"
#include "lodestone/mesh/workers.h"

namespace lodestone {

/// Exact confirmation of candidate pairs. Keeps its working memory, so a frame allocates nothing once the largest
/// patches have been confirmed.
class Confirmation {
 public:
  /// Makes room for patches of so many faces and vertices.
  void reserve(std::size_t faces, std::size_t vertices);

  /// Appends the intersecting face pairs of two posed patches to `found`. With a query other than `all`, stops at the
  /// first.
  ///
  /// First the overlap of the two boxes culls the faces outside of it. Then a sweep along the longest axis of the
  /// overlap culls pairs, and `triangles_intersect` decides the rest. O(n + m) for patches that are not near each
  /// other; O(n + m + s log s + pairs that overlap along the axis) for the s faces within the overlap; all n m pairs at
  /// worst.
  ///
  /// @param workers  share the sweep; what is found does not depend on their number
  /// @return whether a pair was found
  bool confirm(const Posed_patch& a, const Posed_patch& b, Contact_query query, std::vector<Face_pair>& found,
               Workers& workers = Workers::alone());

  /// Face pairs that went to the exact test since `reset_count`.
  std::size_t exact_tests() const { return exact_tests_; }
  /// Sets `exact_tests` to 0.
  void reset_count() { exact_tests_ = 0; }

 private:
  struct Boxed_face {
    Box box;
    std::uint32_t index;  ///< in the patch
  };

  /// A face of the sweep, and the faces of the other patch that begin after it.
  struct Turn {
    const Boxed_face* face;
    std::span<const Boxed_face> ahead;
    bool of_a;
  };
  /// What a part of the sweep found.
  struct Part {
    std::vector<Face_pair> found;
    std::size_t exact_tests = 0;
  };
  /// The two patches that are being confirmed.
  struct Question {
    const Posed_patch& a;
    const Posed_patch& b;
    int axis;  ///< of the sweep
    bool all;  ///< all contacts; false: one
  };

  void faces_within(const Posed_patch& posed, const Box& overlap, std::vector<Boxed_face>& faces);
  void sort_faces(int axis, Workers& workers);
  void list_turns(int axis);
  static bool sweep(const Question& question, std::span<const Turn> turns, std::vector<Face_pair>& found,
                    std::size_t& exact_tests);
  bool sweep_in_parts(const Question& question, std::vector<Face_pair>& found, Workers& workers);

  Unset_vector<std::uint8_t> sides_;  ///< per vertex of a patch: those of the overlap that it lies beyond
  std::vector<Boxed_face> faces_a_, faces_b_;
  std::vector<Turn> turns_;
  std::vector<Part> parts_;
  std::size_t exact_tests_ = 0;
};

}  // namespace lodestone
