// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lodestone/detection/detector_options.h"
#include "lodestone/detection/pair_memory.h"
#include "lodestone/detection/particle_object.h"
#include "lodestone/particles/ring_check.h"
#include "lodestone/queries/opening_search.h"

namespace lodestone {

/// What a search has cost since the start of the frame.
struct Meeting_counts {
  std::size_t meetings = 0;       ///< walks of two particles towards each other
  std::size_t leaf_tests = 0;     ///< leaf pairs whose faces were compared
  std::size_t exact_tests = 0;    ///< face pairs given to exact predicates
  std::size_t vertices_read = 0;  ///< by walks and checks; what trees read, they count themselves
};

/// What searches know of the pairs of a frame, in lists of all pairs that one search has looked at.
struct Pair_lists {
  std::vector<Near_regions> near_regions;  ///< see `Met_pair::near_regions`
  std::vector<Remembered_meeting> seeds;   ///< see `Met_pair::seeds`
  std::vector<Face_pair> of_look;          ///< see `Met_pair::contacts_of_look`
  std::vector<Leaf_pair> compared;         ///< see `Met_pair::compared`
  std::vector<Face_pair> of_curves;        ///< see `Met_pair::contacts_of_curves`

  /// Forgets all pairs.
  void clear() {
    near_regions.clear();
    seeds.clear();
    of_look.clear();
    compared.clear();
    of_curves.clear();
  }
};

/// Entries of one pair in such a list. All pairs share a list, so that a frame allocates nothing.
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
  Object_pair ids;                          ///< the two objects
  Particle_object* a = nullptr;             ///< the first
  Particle_object* b = nullptr;             ///< the second
  Pair_lists* lists = nullptr;              ///< of the search that has looked at it
  const Pair_lists* followed_in = nullptr;  ///< of the search that has followed its curves; null: none has
  Entries near_entries = {};                ///< in the lists
  Entries seed_entries = {};                ///< in the lists
  Entries look_entries = {};                ///< in the lists
  Entries compared_entries = {};            ///< in the lists
  Entries curve_entries = {};               ///< in the lists of `followed_in`
  std::size_t followed_count = 0;           ///< of `contacts_of_look()`, those of known curves, which come first
  std::size_t leaf_tests = 0;               ///< leaf pairs whose faces were compared
  bool out_of_budget = false;               ///< the regions could not all be opened
  bool limited = false;                     ///< the budget could have ended the openings

  /// Its regions that may touch, if `look` had to list them.
  std::span<const Near_regions> near_regions() const { return near_entries.of(lists->near_regions); }
  /// Where its particles met, and the contacts there. If they met nowhere, one contact that openings found.
  std::span<const Remembered_meeting> seeds() const { return seed_entries.of(lists->seeds); }
  /// The contacts that `look` has found, on the curves of the last frame and by openings.
  std::span<const Face_pair> contacts_of_look() const { return look_entries.of(lists->of_look); }
  /// Leaf pairs that have been compared.
  std::span<const Leaf_pair> compared() const { return compared_entries.of(lists->compared); }
  /// All contacts, those of `look` included, once `follow_curves` has gone through them and on along their curves.
  std::span<const Face_pair> contacts_of_curves() const {
    return followed_in != nullptr ? curve_entries.of(followed_in->of_curves) : std::span<const Face_pair>();
  }

  /// Whether several threads may read both objects at once.
  bool is_shared() const { return a->positions().is_shared() && b->positions().is_shared(); }
};

/// Searches object pairs in mode `particles`, one after the other: see Meeting_search. It reads the two objects of a
/// pair, and no others; two searches can work side by side on pairs that have no object in common. Keeps its memory.
class Pair_search {
 public:
  /// @param options        which contacts are asked for; how many meetings, and how much to open
  /// @param memory, curves  of the last frame; must outlive this, and must not change but in `start_frame`
  Pair_search(const Detector_options& options, const Meeting_memory& memory, const Pair_memory<Face_pair>& curves)
      : options_(options), memory_(memory), curves_(curves) {}

  /// Forgets the pairs of the last frame. Counts begin at 0.
  void start_frame();
  /// Searches where particles met in the last frame, then below the regions. The workers share tests of faces.
  void look(Met_pair& pair, Workers& workers);
  /// Lets the particles of near regions meet, and checks the faces around: the nearest first, as many as the options
  /// allow. Any search may have looked at the pair.
  void meet_nearest(Met_pair& pair);
  /// Lists the contacts on the curves through the seeds, if there are any. Any search may have looked at the pair. The
  /// workers share tests of faces.
  void follow_curves(Met_pair& pair, Workers& workers);
  /// The same, but forgets the contacts of all pairs before.
  void follow_curves_alone(Met_pair& pair, Workers& workers) {
    lists_.of_curves.clear();
    follow_curves(pair, workers);
  }

  /// Whether the answer for a pair is known.
  bool decided(const Met_pair& pair) const { return pair.seed_entries.count > 0 && !wants_all(); }
  /// What the search has cost in this frame.
  Meeting_counts counts() const;

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
  void count_openings(Met_pair& pair);
  void add_seed(Met_pair& pair, const Remembered_meeting& seed);

  const Detector_options& options_;
  const Meeting_memory& memory_;
  const Pair_memory<Face_pair>& curves_;
  Ring_check rings_;
  Opening_search openings_;
  Meeting_counts counts_;
  Pair_lists lists_;
  // Memory.
  std::vector<Face_pair> contacts_;
  std::vector<Candidate_pair> nearest_;
  std::vector<Opening_start> starts_;
};

/// Particles of both surfaces of a pair at a contact.
Remembered_meeting met_at(const Met_pair& pair, Face_pair contact);

}  // namespace lodestone
