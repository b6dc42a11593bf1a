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

/// What takes part in a race: a measured run of several methods over the same frames.
namespace lodestone {

/// What one frame took, and what was answered. All figures are sums over the objects, or over the pairs asked for.
struct Answer {
  double update_seconds = 0;
  double any_seconds = 0;                        ///< infinite: not asked in this round
  double all_seconds = 0;                        ///< infinite: not asked in this round
  bool gave_up = false;                          ///< in one of the queries: only the update counts
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

  /// What a library that allocates past the heap says itself that it holds; called right after it was built.
  virtual std::optional<std::size_t> bytes() const { return std::nullopt; }
  /// Whatever only the measurement needs: called once, after time and memory of the build have been taken.
  virtual void prepare() {}
  /// Whether `approach` wants to be called: by methods whose frame goes on from the one before.
  virtual bool wants_approach() const { return false; }
  /// Called for each frame of the scene that comes before a sampled one and after the sampled one before that, when the
  /// meshes are as they are in it. What it takes is no part of the figures of a frame.
  virtual void approach() {}
  /// How often a pass goes over all sampled frames: twice for who answers the two questions one after the other.
  virtual std::size_t rounds() const { return 1; }
  /// Begins to go over all sampled frames. In the rounds of a pass together each question is asked once in every frame.
  /// @param round  of the pass: < rounds()
  virtual void start_round(std::size_t /*round*/) {}
  /// Updates all objects, then asks about the pairs: first whether they collide, then for all contacts.
  /// @return valid until the next call
  virtual const Answer& play(std::span<const Object_pair> pairs) = 0;
  /// Called once per sampled frame when all passes are over, not timed: what is to be counted is counted here.
  /// @param frame  its place among the sampled ones, of which there are `frames`
  virtual void inspect(std::span<const Object_pair> /*pairs*/, std::size_t /*frame*/, std::size_t /*frames*/) {}
};

/// What stands in the row of a table, and how its entrant is made.
struct Entry {
  std::string library;
  std::string method;
  std::string volume;
  std::size_t threads = 1;
  bool answers = true;        ///< false: a bound, which answers nothing
  bool reports_pairs = true;  ///< false: `Answer::contacts` means nothing
  std::function<std::unique_ptr<Entrant>(std::span<const Moving_mesh>)> build = nullptr;

  std::string name() const { return library + ": " + method; }
};

/// The bound of any exact method: every vertex is read once, and nothing answered.
Entry read_bound_entry();

}  // namespace lodestone
