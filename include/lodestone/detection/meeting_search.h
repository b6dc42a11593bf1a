// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lodestone/detection/detector_options.h"
#include "lodestone/detection/frame.h"
#include "lodestone/detection/pair_memory.h"
#include "lodestone/detection/particle_object.h"
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

/// Some entries in a list of all object pairs.
struct Entries {
  std::size_t first = 0;  ///< index of the first
  std::size_t count = 0;  ///< how many they are

  /// The entries themselves.
  template <class Entry>
  std::span<const Entry> of(const std::vector<Entry>& all) const {
    return std::span(all).subspan(first, count);
  }
};

/// An object pair, and what the search knows of it in this frame.
struct Met_pair {
  Object_pair ids;                 ///< the two objects
  Particle_object* a = nullptr;    ///< the first
  Particle_object* b = nullptr;    ///< the second
  Entries near = {};               ///< its regions that may touch: see `Meeting_search::near_regions`
  Entries seeds = {};              ///< its first contacts: see `Meeting_search::seeds`
  Entries opened = {};             ///< contacts that curves and openings gave to `look`
  std::size_t followed_count = 0;  ///< of these, the contacts of curves, which come first
  Entries compared = {};           ///< leaf pairs that have been compared
  bool out_of_budget = false;      ///< the regions could not all be opened
};

/// The search for contacts of object pairs in mode `particles`, from what is cheapest to what finds most:
///  1. `look`: at the place where particles met in the last frame, then below the regions, which are read as a whole or
///     opened. If all contacts are asked for and regions are opened, the curves through that place come first;
///  2. `meet_nearest`, where the budget has ended the openings, after the particles have walked;
///  3. `report`: with the query `all`, along the curves of intersection through the contacts that were found.
///
/// In each of these calls the pairs of a frame must come in ascending order.
class Meeting_search {
 public:
  /// @param options  which contacts are asked for; how many meetings, and how much to open
  explicit Meeting_search(const Detector_options& options) : options_(options) {}

  /// Starts a frame: counts begin at 0.
  void start_frame();
  /// As if the frame had not been started, for the next one.
  void undo_frame() {
    memory_.undo_frame();
    curves_.undo_frame();
  }
  /// Searches where particles met in the last frame, then below the regions. The workers share tests of faces.
  void look(Met_pair& pair, Workers& workers);
  /// Lets the particles of near regions meet, and checks the faces around: the nearest first, as many as the options
  /// allow.
  void meet_nearest(Met_pair& pair);
  /// Appends the contacts that answer the query to `found`, and remembers where they are for the next frame. The
  /// workers share tests of faces.
  void report(const Met_pair& pair, std::vector<Face_pair>& found, Workers& workers);

  /// Whether the answer for a pair is known.
  bool decided(const Met_pair& pair) const { return pair.seeds.count > 0 && !wants_all(); }
  /// The regions of a pair that may touch, if `look` had to list them.
  std::span<const Near_regions> near_regions(const Met_pair& pair) const { return pair.near.of(near_regions_); }
  /// Where particles of a pair met, and the contacts there. If they met nowhere, one contact that openings found.
  std::span<const Remembered_meeting> seeds(const Met_pair& pair) const { return pair.seeds.of(seeds_); }
  /// What the search has cost in this frame.
  Meeting_counts counts() const;

  /// Forgets an object, which has been rebuilt or removed.
  void forget(Object_id object) {
    memory_.forget(object);
    curves_.forget(object);
  }

 private:
  bool wants_all() const { return options_.contacts == Contact_query::all; }
  void revisit(Met_pair& pair);
  bool still_meet(const Met_pair& pair, Face_pair contact);
  std::size_t meet_from(Met_pair& pair, Meeting start, std::size_t most_hops);
  static std::size_t hop_limit(const Met_pair& pair);
  void list_regions(Met_pair& pair);
  void open(Met_pair& pair, Workers& workers);
  std::size_t most_whole() const;
  void begin_openings(const Met_pair& pair, bool opened);
  void follow_known_curves(const Met_pair& pair, Workers& workers);
  static Remembered_meeting met_at(const Met_pair& pair, Face_pair contact);
  void count_openings();
  void add_seed(Met_pair& pair, const Remembered_meeting& seed);
  void follow_curves(const Met_pair& pair, std::vector<Face_pair>& found, Workers& workers);
  void remember_one(const Met_pair& pair);
  void remember_some(const Met_pair& pair, std::span<const Face_pair> contacts);
  void remember_curves(const Met_pair& pair, std::span<const Face_pair> contacts);

  const Detector_options options_;
  Meeting_memory memory_;
  Pair_memory<Face_pair> curves_;  ///< of searches for all contacts that openings do not finish: a contact in each pair
                                   ///< of leaves that has any
  Ring_check rings_;
  Opening_search openings_;
  Meeting_counts counts_;

  // Of all pairs in this frame.
  std::vector<Near_regions> near_regions_;
  std::vector<Remembered_meeting> seeds_;
  std::vector<Face_pair> opened_;
  std::vector<Leaf_pair> compared_;
  // Memory.
  std::vector<Face_pair> contacts_;
  std::vector<Candidate_pair> nearest_;
  std::vector<Opening_start> starts_;
};

}  // namespace lodestone
