// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "lodestone/detection/frame.h"
#include "lodestone/detection/pair_levels.h"
#include "lodestone/detection/pair_search.h"
#include "lodestone/mesh/workers.h"

namespace lodestone {

/// The search for contacts of object pairs in mode `particles`, from what is cheapest to what finds most:
///  1. `look`: at the place where particles met in the last frame, then below the regions, which are read as a whole or
///     opened. If all contacts are asked for and regions are opened, the curves through that place come first;
///  2. `meet_nearest`, where the budget has ended the openings, after the particles have walked;
///  3. `follow_shared_curves`: with the query `all`, along the curves of intersection through the contacts that were
///  found;
///  4. `report`.
///
/// Many pairs are searched side by side, each by one worker. What a pair costs, and where its budget ends, depends on
/// what earlier pairs have read of its two objects, so each object meets the others in the order of the pairs, however
/// many workers there are.
class Meeting_search {
 public:
  /// @param options  which contacts are asked for; how many meetings, and how much to open
  /// @param workers  must outlive this
  Meeting_search(const Detector_options& options, Workers& workers) : options_(options), workers_(workers) {
    searches_.emplace_back(options_, memory_, curves_);
  }
  Meeting_search(const Meeting_search&) = delete;  // searches refer to it
  Meeting_search& operator=(const Meeting_search&) = delete;

  /// Starts a frame: counts begin at 0.
  void start_frame();
  /// As if the frame had not been started, for the next one.
  void undo_frame() {
    memory_.undo_frame();
    curves_.undo_frame();
  }
  /// Searches where the particles of each pair met in the last frame, then below the regions.
  /// @param pairs  all of the frame, ascending
  void look(std::span<Met_pair> pairs);
  /// Lets the particles of near regions of a pair meet: see `Pair_search::meet_nearest`.
  void meet_nearest(Met_pair& pair) { searches_.front().meet_nearest(pair); }
  /// With the query `all`, lists the contacts on the curves through the seeds of each pair, if the pairs are shared.
  /// Otherwise `report` does, pair by pair: it takes less memory.
  /// @param pairs  those that were given to `look`
  void follow_shared_curves(std::span<Met_pair> pairs);
  /// Appends the contacts that answer the query to `found`, and remembers where they are for the next frame. The pairs
  /// of a frame must come in ascending order.
  void report(Met_pair& pair, std::vector<Face_pair>& found);

  /// Whether the answer for a pair is known.
  bool decided(const Met_pair& pair) const { return searches_.front().decided(pair); }
  /// What the search has cost in this frame.
  Meeting_counts counts() const;

  /// Forgets an object, which has been rebuilt or removed.
  void forget(Object_id object) {
    memory_.forget(object);
    curves_.forget(object);
  }

 private:
  bool wants_all() const { return options_.contacts == Contact_query::all; }
  bool are_worth_sharing(std::size_t pairs) const;
  template <class Step>
  void for_each(std::span<Met_pair> pairs, const Step& step);
  template <class Step>
  void share_level(std::span<const std::uint32_t> level, std::span<Met_pair> pairs, const Step& step);
  void remember_one(const Met_pair& pair);
  void remember_some(const Met_pair& pair);
  void remember_curves(const Met_pair& pair);

  const Detector_options options_;
  Workers& workers_;
  Meeting_memory memory_;
  Pair_memory<Face_pair> curves_;     ///< of searches for all contacts that openings do not finish: a contact in each
                                      ///< pair of leaves that has any
  std::deque<Pair_search> searches_;  ///< one; per worker, once pairs have been shared
  Pair_levels levels_;                ///< of the pairs of this frame, if they are shared
  // Memory.
  std::vector<Object_pair> ids_;
  std::vector<std::uint32_t> shared_;  ///< pairs of a level that several threads may read
};

}  // namespace lodestone
