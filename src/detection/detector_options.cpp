// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/detector_options.h"

#include <cmath>

#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

void require(bool holds, const char* requirement) {
  if (!holds) throw Bad_argument(requirement);
}

/// Meetings decide without what the published method needs.
bool has_defaults_of_candidates(const Detector_options& options) {
  const Detector_options defaults;
  return options.collision_distance == defaults.collision_distance &&
         options.distance_measure == defaults.distance_measure && options.candidates == defaults.candidates;
}

/// Modes without particles must not ignore silently what only particles have.
bool has_defaults_of_particles(const Detector_options& options) {
  const Detector_options defaults;
  return has_defaults_of_candidates(options) && options.close_seams == defaults.close_seams;
}

bool has_defaults_of_meetings(const Detector_options& options) {
  const Detector_options defaults;
  return options.meetings == defaults.meetings && options.opening_budget == defaults.opening_budget &&
         options.opening_reach == defaults.opening_reach;
}

bool has_defaults_of_exact(const Exact_options& exact) {
  return !has_tolerance(exact) && !exact.self_collision && !exact.containment && !exact.parting && !exact.patches &&
         exact.loosest == Exact_options().loosest;
}

}  // namespace

void check(const Detector_options& options) {
  const Exact_options& exact = options.exact;
  require(options.collision_distance > 0 && std::isfinite(options.collision_distance),
          "the collision distance must be finite and > 0");
  require(options.growth > 0, "the growth limit must be > 0");
  require(options.opening_reach > 0 && std::isfinite(options.opening_reach),
          "the reach of openings must be finite and > 0");
  require(options.mode == Mode::particles || has_defaults_of_meetings(options),
          "meetings, and the budget and the reach of openings, need the mode particles");
  require(options.mode != Mode::particles || options.meetings == 0 || has_defaults_of_candidates(options),
          "with meetings the collision distance, its measure and the choice of candidates have no effect: set meetings "
          "to 0");
  require(options.most_contacts > 0, "most_contacts must be at least 1");
  require(options.contacts != Contact_query::yes_no ||
              (!options.contact_points && !options.contact_normals && !exact.patches),
          "contact points, normals and patches need the contacts `first` or `all`");
  require(exact.tolerance >= 0 && std::isfinite(exact.tolerance), "the tolerance must be finite and >= 0");
  require(exact.self_tolerance >= 0 && std::isfinite(exact.self_tolerance),
          "the tolerance within one object must be finite and >= 0");
  require(exact.loosest > 1, "a tree must be allowed to become looser than it was built: the factor must be > 1");
  check(exact.tree);
  require(
      finds_all(options.mode) || has_defaults_of_exact(exact),
      "a distance other than 0, self-collision, containment, parting, contact patches and the limit of looseness need "
      "the mode exact or certified");
  require(options.mode == Mode::certified || !exact.throw_if_broken, "throw_if_broken needs the mode certified");
  require(!finds_all(options.mode) || has_defaults_of_particles(options),
          "the collision distance, its measure, the choice of candidates and open seams need the mode particles or "
          "senin");
  require(options.mode == Mode::particles || options.growth == Detector_options().growth,
          "the growth limit needs the mode particles");
}

std::string title_of(std::uint32_t object, const Object_options& options) {
  const std::string id = "object " + std::to_string(object);
  return options.name.empty() ? id : id + " (" + options.name + ")";
}

}  // namespace lodestone
