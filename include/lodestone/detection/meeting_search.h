// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lodestone/detection/detector_options.h"
#include "lodestone/detection/meeting_memory.h"
#include "lodestone/detection/particle_object.h"
#include "lodestone/particles/contact_curve.h"
#include "lodestone/particles/ring_check.h"
#include "lodestone/queries/opening_search.h"

namespace lodestone {

/// What a search has cost since the start of the frame.
struct Meeting_counts {
  std::size_t meetings = 0;       ///< walks of two particles towards each other
  std::size_t openings = 0;       ///< leaf pairs whose faces were compared
  std::size_t exact_tests = 0;    ///< face pairs given to exact predicates
  std::size_t vertices_read = 0;  ///< by walks and checks; what trees read, they count themselves
};

/// The objects of one pair, and what is known of them in this frame.
struct Met_pair {
  Object_pair ids;
  Particle_object* a = nullptr;
  Particle_object* b = nullptr;
  std::size_t first_near = 0, near_count = 0;  ///< of `Meeting_search::near_regions`
  bool met = false;                            ///< `found` holds a contact
  Remembered_meeting found = {};
};

/// The search for contacts of object pairs in mode `particles`, from what is cheapest to what finds most: where
/// particles met in the last frame; where the nearest particles meet; below the regions, which are opened.
class Meeting_search {
 public:
  explicit Meeting_search(const Detector_options& options) : options_(options) {}

  void start_frame();
  /// Looks where the particles of a pair met in the last frame. In ascending order of pairs.
  /// @return whether there is a contact
  bool revisit(Met_pair& pair);
  /// Lists the regions of a pair that may touch.
  /// @return whether there are any: otherwise the objects are taken to be apart
  bool list_regions(Met_pair& pair);
  std::span<const Near_regions> near_regions(const Met_pair& pair) const {
    return std::span(near_regions_).subspan(pair.first_near, pair.near_count);
  }
  /// Lets two particles meet, and checks the faces around.
  /// @return whether there is a contact
  bool meet_from(Met_pair& pair, Meeting start);
  /// Opens the regions of a pair, which have been listed.
  /// @return whether there is a contact
  bool open(Met_pair& pair);
  /// Finds all contacts of a pair, in ascending order of pairs, and lists its regions.
  /// @return whether there are any
  bool find_all(Met_pair& pair, std::vector<Face_pair>& found);
  /// Remembers what was found of a pair without `find_all`. In ascending order of pairs.
  void remember(const Met_pair& pair);
  /// Forgets an object, which has been rebuilt or removed.
  void forget(Object_id object) { memory_.forget(object); }

  const Meeting_counts& counts() const { return counts_; }

 private:
  bool still_meet(const Met_pair& pair, Face_pair contact);
  void begin_search(const Met_pair& pair);
  static Remembered_meeting meeting_at(const Met_pair& pair, Face_pair contact);

  const Detector_options options_;
  Meeting_memory memory_;
  Ring_check rings_;
  Contact_curve curves_;
  Opening_search openings_;
  Meeting_counts counts_;
  std::vector<Near_regions> near_regions_;  ///< of all pairs in this frame
  std::vector<Face_pair> opened_;           ///< memory
};

}  // namespace lodestone
