// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lodestone/mesh/pairs.h"
#include "lodestone/particles/walked_surface.h"

namespace lodestone {

/// Follows curves of intersection: from a face pair that intersects to those that intersect beside it, across the edges
/// of either face. Two surfaces meet along curves, so all contacts of a curve are found from one of them.
///
/// Keeps its memory from one object pair to the next.
class Contact_curve {
 public:
  /// Starts anew, for two surfaces.
  void begin(const Walked_surface& a, const Walked_surface& b);

  /// Follows the curve through a contact, and appends all that is found to `found`, the contact too, each once.
  /// Contacts that were followed before are left out, so nothing is appended for a contact on the same curve. O(1)
  /// exact tests per contact found, for surfaces whose vertices have few faces.
  void follow(Face_pair contact, std::vector<Face_pair>& found);

  /// Face pairs given to exact predicates, and positions read, since `begin`.
  /// Face pairs given to exact predicates since `begin`.
  std::size_t exact_tests() const { return exact_tests_; }
  /// Positions read since `begin`, some more than once.
  std::size_t vertices_read() const { return vertices_read_; }

 private:
  /// A set of face pairs that keeps its memory: open addressing, cleared in O(1).
  class Pair_set {
   public:
    void clear();
    /// @return whether the pair was not in the set
    bool insert(Face_pair pair);

   private:
    struct Slot {
      Face_pair pair;
      std::uint64_t round = 0;  ///< the slot is taken if this is the current round
    };
    std::size_t slot_of(Face_pair pair) const;
    void grow();

    std::vector<Slot> slots_;
    std::size_t size_ = 0;
    std::uint64_t round_ = 0;
  };

  template <class Visit>
  static void for_each_beside(const Walked_surface& surface, std::uint32_t face, Visit visit);
  void test(Face_pair pair);

  Walked_surface a_, b_;
  Pair_set seen_;                   ///< face pairs that were tested
  std::vector<Face_pair> waiting_;  ///< contacts whose neighbours are to be tested
  std::size_t exact_tests_ = 0, vertices_read_ = 0;
};

}  // namespace lodestone
