// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lodestone/mesh/pairs.h"
#include "lodestone/queries/contact_patches.h"
#include "lodestone/queries/parting.h"
#include "lodestone/triangles/contact_normal.h"
#include "lodestone/triangles/triangle_intersection.h"

namespace lodestone {

/// Number of an object within its detector, from 0 in the order of `add`.
using Object_id = std::uint32_t;

/// Seconds spent in each stage of one frame, and before it since the frame before.
///
/// An object is built once, in its first frame, and again after the caller's `rebuild`. What its motion asks for later
/// counts as `repartition`: a new partition of an object that has outgrown A*, a new tree for one that has become
/// loose. With meetings nearly all time of a frame is `confirmation`: there the search is no stage of its own.
struct Stage_times {
  double build = 0;         ///< numbering, partition and tree of objects that are new, or that the caller rebuilt
  double repartition = 0;   ///< growth checks and repartitions; in mode exact rebuilding loose trees
  double refit = 0;         ///< mode exact: reading all positions, fitting all volumes
  double broad_phase = 0;   ///< reading the particles, or with meetings small objects and the anchors of regions;
                            ///< candidate object pairs
  double relaxation = 0;    ///< particles walking
  double candidates = 0;    ///< as published: particle pairs below the collision distance
  double confirmation = 0;  ///< as published: exact checks of candidate regions. With meetings, and in modes exact and
                            ///< certified: the whole search of all pairs, and what was asked for about their contacts

  /// All stages but `build`: what a frame takes once its objects stand.
  double without_build() const { return repartition + refit + broad_phase + relaxation + candidates + confirmation; }
  /// All stages.
  double total() const { return build + without_build(); }
};

/// What a frame took, and what it did.
struct Frame_statistics {
  Stage_times seconds = {};           ///< per stage
  std::size_t object_candidates = 0;  ///< number of `Frame::pairs`: those that broad phase and collision filter let
                                      ///< pass, or the one asked for; those of an object with itself included
  std::size_t iterations = 0;         ///< of the relaxation
  std::size_t moves = 0;              ///< steps of all particles together
  bool relaxed = true;                ///< false: the relaxation was stopped by R_max
  std::size_t meetings = 0;           ///< pairs of particles that walked towards each other
  std::size_t vertices_read = 0;      ///< positions read, some more than once
  std::size_t nodes_bounded = 0;      ///< mode certified: boxes that come from bounds, without reading
  std::size_t leaves_posed = 0;       ///< mode certified: leaves of objects with bounds that were read
  std::size_t violations = 0;         ///< mode certified: promises that what was read did not keep
  std::size_t candidates = 0;         ///< modes with particles: candidate region pairs
  std::size_t leaf_tests = 0;         ///< pairs of leaves whose faces were compared; with meetings below regions that
                                      ///< may touch, and along curves
  std::size_t exact_tests = 0;        ///< face pairs given to the exact test
  std::size_t contacts = 0;           ///< face pairs that are listed, each once: see `face_pairs`
  std::size_t builds = 0;             ///< objects built: see Stage_times
  std::size_t repartitions = 0;  ///< objects repartitioned since the frame before; in mode exact loose trees rebuilt
};

/// Whether one object lies inside the other: their surfaces are apart, and every component of it is enclosed.
enum class Containment {
  none,    ///< neither inside the other
  a_in_b,  ///< the first inside the second
  b_in_a,  ///< the second inside the first
};

/// What was found for one candidate object pair, a < b; or, with a = b, within one object.
struct Pair_result {
  Object_id a = 0;                ///< first object
  Object_id b = 0;                ///< second object, or the first again
  bool collides = false;          ///< two faces intersect
  bool near = false;              ///< two faces are nearer than the tolerance, or intersect; false without a tolerance.
                                  ///< Within one object faces that were near when it was built do not count
  std::size_t candidates = 0;     ///< modes with particles: candidate region pairs
  std::size_t leaf_tests = 0;     ///< pairs of leaves whose faces were compared
  std::size_t first_contact = 0;  ///< index of the first of its face pairs in `Frame::face_pairs`
  std::size_t contacts = 0;       ///< number of its face pairs in `Frame::face_pairs`
  bool capped = false;            ///< there are more face pairs than `Detector_options::most_contacts`
  bool unfinished = false;        ///< mode particles, with meetings: the budget of openings ended the search before it
                                  ///< had found what was asked for, so contacts can be missing
  Containment containment = Containment::none;  ///< which object lies inside the other; none unless asked for
  std::optional<Parting> parting = {};          ///< `a` is moved; none unless asked for and needed
  std::size_t first_patch = 0;                  ///< index of the first of its contact patches in `Frame::patches`
  std::size_t patches = 0;                      ///< number of its contact patches in `Frame::patches`
};

/// Two regions that may touch, so that their faces were to be checked: their particles came nearer than the collision
/// distance, or, with meetings, parts of the surfaces are near.
struct Candidate_regions {
  Object_id a = 0;            ///< first object
  Region_index region_a = 0;  ///< its number within `a`; in mode senin the particle's, which has no region
  Object_id b = 0;            ///< second object
  Region_index region_b = 0;  ///< the same within `b`
  double distance = 0;  ///< of the two particles after their walk, in units of the coordinates; with meetings of the
                        ///< vertices by which the regions were found to be near
};

/// Everything one frame brought. Pairs rejected by the broad phase are omitted.
struct Frame {
  std::uint64_t number = 0;        ///< counts from 1; skips numbers that failed frames have used
  std::vector<Pair_result> pairs;  ///< by (a, b)
  /// Contacts of all pairs one after the other, sorted within a pair. With a tolerance those that intersect and those
  /// that are only near: see `intersects`.
  std::vector<Face_pair> face_pairs;
  /// Parallel to `face_pairs`, without a tolerance empty: 1 where the two faces intersect, 0 where they are nearer than
  /// the tolerance but apart.
  std::vector<std::uint8_t> contact_intersects = {};
  /// Parallel to `face_pairs`; empty unless asked for, or patches are. Faces that are near but apart: the nearest point
  /// of each.
  std::vector<Intersection_points> contact_points;
  /// Parallel to `face_pairs`; empty unless asked for, or patches are. A negative depth tells faces that are near but
  /// apart.
  std::vector<Contact_normal> contact_normals;
  /// Contact patches of all pairs one after the other; empty unless asked for. Their contacts count from the first of
  /// the pair.
  std::vector<Contact_patch> patches = {};
  /// `Pair_result::candidates` of each pair, one pair after the other, nearest first within a pair; empty unless asked
  /// for. Once a face pair has answered the query, the farther ones of its pair are not checked any more.
  std::vector<Candidate_regions> candidates = {};
  /// Per object: iterations of the relaxation in which one of its particles looked at its steps. In the others all were
  /// at rest, or known to swing between two vertices. Empty if no particle walked.
  std::vector<std::size_t> object_iterations = {};
  Frame_statistics statistics = {};  ///< what it took, and what it did

  /// What was found for two objects, in either order. O(log pairs).
  /// @return null if they are not among `pairs`: the broad phase rejected them, or they were left out
  const Pair_result* find(Object_id a, Object_id b) const {
    const Object_pair asked{std::min(a, b), std::max(a, b)};
    const auto of_pair = [](const Pair_result& pair) { return Object_pair{pair.a, pair.b}; };
    const auto found = std::ranges::lower_bound(pairs, asked, {}, of_pair);
    return found != pairs.end() && of_pair(*found) == asked ? &*found : nullptr;
  }
  /// The contacts of one of `pairs`.
  std::span<const Face_pair> contacts(const Pair_result& pair) const {
    return std::span(face_pairs).subspan(pair.first_contact, pair.contacts);
  }
  /// Whether the two faces of a contact intersect; false: they are near but apart.
  /// @param contact  index in `face_pairs`
  bool intersects(std::size_t contact) const { return contact_intersects.empty() || contact_intersects[contact] != 0; }
  /// The contact patches of one of `pairs`.
  std::span<const Contact_patch> patches_of(const Pair_result& pair) const {
    return std::span(patches).subspan(pair.first_patch, pair.patches);
  }
  /// Whether any pair collides.
  bool collides() const { return std::ranges::any_of(pairs, &Pair_result::collides); }
  /// Whether any pair is near.
  bool near() const { return std::ranges::any_of(pairs, &Pair_result::near); }
  /// Whether `face_pairs` lacks some that were cut off by `Detector_options::most_contacts`.
  bool capped() const { return std::ranges::any_of(pairs, &Pair_result::capped); }
  /// Whether the budget of openings ended the search of a pair: see `Pair_result::unfinished`.
  bool unfinished() const { return std::ranges::any_of(pairs, &Pair_result::unfinished); }
};

}  // namespace lodestone
