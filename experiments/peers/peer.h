// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "lodestone/particles/confirmation.h"
#include "shared/entrant.h"

/// Other libraries that answer the same question, each behind the same interface.
namespace lodestone {

/// Seconds after which a query may give up; some queries would take hours on a large scene.
constexpr double patience = 1;
/// Thrown by a query that has given up.
struct Gave_up {};

/// One library, used in one way. Objects have indices from 0, in the order of `add`. One thread calls at a time.
class Peer {
 public:
  Peer() = default;
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;
  virtual ~Peer() = default;

  /// Builds all that the library keeps of a mesh, from the current positions.
  virtual void add(const Moving_mesh& mesh) = 0;
  /// Updates an object to the current positions: all work that is due once per frame and object, including the
  /// conversion to the library's own layout.
  virtual void update(std::size_t object) = 0;
  /// Whether the surfaces of two objects intersect.
  /// @throws Gave_up
  virtual bool any(std::size_t a, std::size_t b) = 0;
  /// Adds all face pairs that intersect to `found`, in any order. Never called for a peer that does not report them.
  /// @throws Gave_up
  virtual void all(std::size_t a, std::size_t b, std::vector<Face_pair>& found) = 0;
  /// Bytes that the library reports to hold, in the heap or elsewhere; none if it keeps no count.
  virtual std::optional<std::size_t> bytes() const { return std::nullopt; }
};

/// A peer and its row in the tables.
struct Peer_kind {
  Entry entry;  ///< without `build`, which `all_entries` adds
  std::unique_ptr<Peer> (*make)() = nullptr;
  bool takes_meshes = false;  ///< as they are: can do without `Moving_mesh::corners`
};

/// The kinds of each library. Each function has a file of its own, and only that file includes the library's headers.
std::vector<Peer_kind> cgal_peers();
std::vector<Peer_kind> fcl_peers();
std::vector<Peer_kind> embree_peers();
std::vector<Peer_kind> bullet_peers();
std::vector<Peer_kind> ode_peers();
/// Embree's slowest build, which is for hierarchies that many queries share; for the experiment `first_answer` alone.
Peer_kind embree_built_well();
/// All but that one, in the order of the tables.
std::vector<Peer_kind> all_peers();

}  // namespace lodestone
