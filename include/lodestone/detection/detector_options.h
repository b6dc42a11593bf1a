// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lodestone/mesh/pairs.h"
#include "lodestone/particles/candidate_pairs.h"
#include "lodestone/particles/collision_distance.h"
#include "lodestone/particles/senin.h"
#include "lodestone/partition/particle_count.h"
#include "lodestone/partition/partition.h"
#include "lodestone/tree/tree_layout.h"

namespace lodestone {

/// Which method answers.
enum class Mode {
  particles,  ///< one particle per region; may miss a collision, reports only true ones
  senin,      ///< the predecessor: particles scattered over the surface, no regions
  exact,      ///< a tree of volumes over the faces: finds what checking every face against every other would
  certified,  ///< as exact, but objects whose motion is bounded are read only where they are near others
};

/// As the options of the program and its results name it.
constexpr std::string_view name_of(Mode mode) {
  constexpr std::string_view names[] = {"particles", "senin", "exact", "certified"};
  return names[static_cast<int>(mode)];
}

/// Whether a mode finds what checking every face against every other would.
constexpr bool finds_all(Mode mode) { return mode == Mode::exact || mode == Mode::certified; }

/// What the modes `exact` and `certified` are asked.
struct Exact_options {
  double tolerance = 0;         ///< report face pairs nearer than this, in units of the coordinates; 0: that intersect.
                                ///< Between two objects. A frame tells apart what is near and what collides, which can
                                ///< take a second yes or no
  bool self_collision = false;  ///< also report pairs of faces of one object
  double self_tolerance = 0;    ///< the same within one object, where its self-collision is asked for: such as the
                                ///< thickness of cloth. Face pairs that share a vertex, or that were nearer than twice
                                ///< this when the object was built, are reported only if they intersect
  bool containment = false;     ///< also tell objects that lie inside others
  bool parting = false;         ///< also give a translation that parts two objects which collide, or of which one lies
                                ///< inside the other; tells containment too
  bool patches = false;         ///< also group the contacts of a pair into contact patches; not with yes_no
  bool throw_if_broken = false;  ///< mode `certified`: a broken bound is a Broken_bound, in place of an exact pass;
                                 ///< all that is read is compared with what was promised
  double loosest = 2;            ///< rebuild an object's tree when its leaves are looser by this factor; > 1
};

/// Whether contacts may be apart.
constexpr bool has_tolerance(const Exact_options& exact) { return exact.tolerance > 0 || exact.self_tolerance > 0; }
/// Below which the faces of a pair are contacts.
constexpr double tolerance_of(const Exact_options& exact, Object_pair pair) {
  return pair.a == pair.b ? exact.self_tolerance : exact.tolerance;
}

/// Options of a Detector, and of one call.
struct Detector_options {
  Mode mode = Mode::exact;  ///< which method answers
  /// In the modes `exact` and `certified` the regions at the top of an object's tree; 0: none, which is fastest to
  /// build: all vertices are then in region 0. In the others the particles of an object; 0: as many as the rule of
  /// `particle_count` asks for.
  std::size_t particles = 0;
  /// Where the rule of `particle_count` decides: at least so many, but never more than its `most_particles`; >= 1.
  /// 1: the rule alone, which can ask for very few. Not in the modes `exact` and `certified`.
  std::size_t least_particles = 12;
  Particle_count_options particle_count = {};  ///< the rule; the modes `exact` and `certified` have none
  Partition_options partition = {};            ///< of the division into regions
  /// Mode `particles`: most pairs of particles of two objects that walk towards each other in a frame, nearest first,
  /// past the borders of their regions. What is around the place where they meet is checked, and the next frame begins
  /// there. Also, regions are opened. 0: as published, particles stay in their regions, and whole regions are checked;
  /// the published method as a whole also has `least_particles` = 1 and `growth` = 1.
  std::size_t meetings = 4;
  /// With meetings: vertices that openings may read per object pair below the regions in a frame; four pairs of nodes
  /// that are compared count as one. What was begun is finished, so it can be some hundred more; two surfaces that have
  /// fewer are searched to the end. Regions that may touch are read as a whole if they have no more than four times
  /// this: for all contacts at once, for one contact after openings have read half of both surfaces. Curves, for
  /// all contacts, are followed without limit; those of the last frame are followed first, and leave at least half of
  /// this. Where it ends a search, `Pair_result::unfinished` says so. 0: regions are not opened.
  std::size_t opening_budget = 16384;
  /// With meetings: two parts of surfaces are taken to be apart if the distance of their anchors is more than so many
  /// times the sum of their radii; > 0. The dial between guess and proof: below 1 less is read and more is missed.
  double opening_reach = 1;
  double collision_distance = 1;  ///< of particles, in multiples of mu, the larger of the two objects'; > 0
  Distance_measure distance_measure = Distance_measure::adjacent_vertices;  ///< of particles: which mean mu is
  Candidate_choice candidates = Candidate_choice::all;                      ///< of particles
  Contact_query contacts = Contact_query::all;                              ///< face pairs to list of each object pair
  bool contact_points = false;                                              ///< where faces meet; not with yes_no
  bool contact_normals = false;                                             ///< which way, how deep; not with yes_no
  bool list_candidates = false;  ///< also `Frame::candidates`; in mode `exact` there are none
  /// Contacts that are listed per object pair; >= 1. In mode `exact` a search ends there; particles find all first.
  std::size_t most_contacts = std::numeric_limits<std::size_t>::max();
  /// Of particles: vertices on open borders that lie on each other when the object is built count as one for the
  /// partition, and particles walk across them: see Closed_seams. Faces keep their corners.
  bool close_seams = true;
  /// Mode `particles`: repartition when a region exceeds so many times A*; > 0; infinity: never. Published: 1.
  double growth = 1.25;
  Senin_options senin = {};  ///< of mode `senin`
  Exact_options exact = {};  ///< of the modes `exact` and `certified`
  /// At most so many; 0: as many as the machine has. Results do not depend on it. For builds, for frames, and for a
  /// strategy whose own option `threads` is 1, such as that of Lbg.
  std::size_t threads = 1;
  Region_tree_options tree = {};  ///< of an object's tree; also of the one that meetings search
};

/// What one object has of its own.
///
/// Groups say which objects are checked against each other: two objects are if each belongs to a group that the other
/// meets. So both must agree, and either can refuse. An object is checked against itself if it meets one of its own
/// groups. By default every object belongs to the first group and meets all 32.
struct Object_options {
  std::size_t particles = 0;                           ///< 0: as the detector's options say
  std::optional<Eigen::Vector3d> scattered_side = {};  ///< Senin_options::side of this object
  std::uint32_t groups = 1;                 ///< bits: the groups that the object belongs to; 0: it meets nothing
  std::uint32_t meets = ~std::uint32_t{0};  ///< bits: the groups that it can collide with; its own too if listed
  /// Per vertex of the mesh: its index in the file, as `read_mesh` gives it. Mode `exact` treats vertices with the same
  /// index as one, at the position of the first. A half-edge mesh stores a non-manifold vertex several times; without
  /// this, faces that share it would count as touching. Empty: no vertices are joined.
  std::vector<std::uint32_t> file_vertex = {};
  std::string name = {};  ///< for messages, beside the id
};

/// What has changed about the faces of a mesh since it was added or rebuilt.
struct Changed_faces {
  /// Indices, in the order of `faces(mesh)`, of the faces whose corners are others than before. New faces at the end
  /// need not be listed, nor those that are gone because there are fewer faces now. `collect_garbage` changes the
  /// corners of faces too, where it moves the last faces and vertices to freed places. A face that has changed and is
  /// not listed goes unnoticed.
  std::span<const std::uint32_t> faces;
};

/// How messages name an object: `object 3`, or `object 3 (cloth)`.
std::string title_of(std::uint32_t object, const Object_options& options);

/// Refuses options that are out of range, and these where they have no effect:
/// - in modes `exact` and `certified`: the collision distance, its measure, the choice of candidates, open seams and
///   the least number of particles;
/// - in other modes: a tolerance of either kind, self-collision, containment, parting, contact patches and the limit of
///   looseness;
/// - in other modes than `certified`: `throw_if_broken`;
/// - in other modes than `particles`: meetings, openings and the growth limit;
/// - with meetings: the collision distance, its measure and the choice of candidates;
/// - with the contacts `yes_no`: contact points, normals and patches.
/// @throws Bad_argument  an option out of its range, or another value than the default for one that has no effect
void check(const Detector_options& options);

}  // namespace lodestone
