// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lodestone/detection/broad_phase.h"
#include "lodestone/particles/confirmation.h"
#include "shared/moving_mesh.h"

/// What takes part in a race: a run that measures several methods on the same frames.
namespace lodestone {

/// Times and answers of one frame. All figures are sums over the objects, or over the pairs asked for.
struct Answer {
  double update_seconds = 0;
  double any_seconds = 0;                        ///< infinite: not asked in this round
  double all_seconds = 0;                        ///< infinite: not asked in this round
  bool gave_up = false;                          ///< a query gave up: only the update counts
  std::vector<bool> collides;                    ///< per pair asked for
  std::size_t elsewhere = 0;                     ///< collisions of pairs not asked for, whose boxes are apart
  std::vector<std::vector<Face_pair>> contacts;  ///< per pair asked for, in any order
};

/// Index of a pair among those asked for; their number if it was not asked for.
inline std::size_t index_of(Object_pair pair, std::span<const Object_pair> pairs) {
  return static_cast<std::size_t>(std::ranges::find(pairs, pair) - pairs.begin());
}

class Entrant {
 public:
  Entrant() = default;
  Entrant(const Entrant&) = delete;
  Entrant& operator=(const Entrant&) = delete;
  virtual ~Entrant() = default;

  /// Bytes that the library reports itself, if it allocates past the heap. Called right after the build.
  virtual std::optional<std::size_t> bytes() const { return std::nullopt; }
  /// Prepares what only the measurement needs. Called once, after time and memory of the build have been taken.
  virtual void prepare() {}
  /// Whether the method needs `approach`, because its frame depends on the frame before.
  virtual bool wants_approach() const { return false; }
  /// Called in each frame between two sampled frames, and before the first, with the meshes posed. Its time is no part
  /// of the figures of a frame.
  virtual void approach() {}
  /// How often a pass goes over all sampled frames: twice for a method that answers one question per round.
  virtual std::size_t rounds() const { return 1; }
  /// Called before each round. Over the rounds of a pass each question is asked once in every frame.
  /// @param round  of the pass: < rounds()
  virtual void start_round(std::size_t /*round*/) {}
  /// Updates all objects, then asks about the pairs: first whether they collide, then for all contacts.
  /// @return valid until the next call
  virtual const Answer& play(std::span<const Object_pair> pairs) = 0;
  /// Called once per sampled frame after all passes, and not timed: the place for counters.
  /// @param frame  index among the `frames` sampled ones
  virtual void inspect(std::span<const Object_pair> /*pairs*/, std::size_t /*frame*/, std::size_t /*frames*/) {}
};

/// A row of a table, and how its entrant is made.
struct Entry {
  std::string library;
  std::string method;         ///< what the library does in each frame
  std::string volume;         ///< bounding volume of the nodes of its tree
  std::size_t threads = 1;    ///< that it may use
  bool answers = true;        ///< false: it is a bound and answers nothing
  bool reports_pairs = true;  ///< false: it leaves `Answer::contacts` unset
  std::function<std::unique_ptr<Entrant>(std::span<const Moving_mesh>)> build = nullptr;

  std::string name() const { return library + ": " + method; }
};

/// The lower bound of any exact method: it reads every vertex once and answers nothing.
Entry read_bound_entry();

}  // namespace lodestone
