// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/detector_options.h"

#include <cmath>

#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

// One call runs this code with cold caches: what throws is kept out of line, so that the usual path is short.
[[noreturn, gnu::cold, gnu::noinline]] void throw_unmet(const char* requirement) { throw Bad_argument(requirement); }
[[noreturn, gnu::cold, gnu::noinline]] void throw_of_other_mode(const char* name, const char* modes) {
  throw Bad_argument(std::string(name) + " needs the mode " + modes);
}

void require(bool holds, const char* requirement) {
  if (!holds) throw_unmet(requirement);
}

/// Refuses an option that would otherwise be ignored silently.
/// @param modes  that take it
void refuse(const char* name, bool is_default, const char* modes) {
  if (!is_default) throw_of_other_mode(name, modes);
}

/// Meetings decide without what the published method needs.
bool has_defaults_of_candidates(const Detector_options& options) {
  const Detector_options defaults;
  return options.collision_distance == defaults.collision_distance &&
         options.distance_measure == defaults.distance_measure && options.candidates == defaults.candidates;
}

void refuse_options_of_other_modes(const Detector_options& options) {
  const Detector_options defaults;
  const Exact_options& exact = options.exact;
  if (!finds_all(options.mode)) {
    constexpr const char* of_all = "exact or certified";
    refuse("tolerance", exact.tolerance == 0, of_all);
    refuse("self_tolerance", exact.self_tolerance == 0, of_all);
    refuse("self_collision", !exact.self_collision, of_all);
    refuse("containment", !exact.containment, of_all);
    refuse("parting", !exact.parting, of_all);
    refuse("patches", !exact.patches, of_all);
    refuse("loosest", exact.loosest == defaults.exact.loosest, of_all);
  }
  if (options.mode != Mode::certified) refuse("throw_if_broken", !exact.throw_if_broken, "certified");
  if (finds_all(options.mode)) {
    constexpr const char* with_particles = "particles or senin";
    refuse("collision_distance", options.collision_distance == defaults.collision_distance, with_particles);
    refuse("distance_measure", options.distance_measure == defaults.distance_measure, with_particles);
    refuse("candidates", options.candidates == defaults.candidates, with_particles);
    refuse("close_seams", options.close_seams, with_particles);
    refuse("least_particles", options.least_particles == defaults.least_particles, with_particles);
  }
  if (options.mode != Mode::particles) {
    refuse("meetings", options.meetings == defaults.meetings, "particles");
    refuse("opening_budget", options.opening_budget == defaults.opening_budget, "particles");
    refuse("opening_reach", options.opening_reach == defaults.opening_reach, "particles");
    refuse("growth", options.growth == defaults.growth, "particles");
  }
}

}  // namespace

void check(const Detector_options& options) {
  const Exact_options& exact = options.exact;
  require(options.collision_distance > 0 && std::isfinite(options.collision_distance),
          "the collision distance must be finite and > 0");
  require(options.growth > 0, "the growth limit must be > 0");
  require(options.opening_reach > 0 && std::isfinite(options.opening_reach),
          "the reach of openings must be finite and > 0");
  require(options.least_particles > 0, "least_particles must be at least 1");
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
  check(options.tree);
  refuse_options_of_other_modes(options);
}

std::string title_of(std::uint32_t object, const Object_options& options) {
  const std::string id = "object " + std::to_string(object);
  return options.name.empty() ? id : id + " (" + options.name + ")";
}

}  // namespace lodestone
