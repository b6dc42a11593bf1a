// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/detection/detector_options.h"

#include <cmath>
#include <initializer_list>

#include "lodestone/mesh/errors.h"

namespace lodestone {

namespace {

void require(bool holds, const char* requirement) {
  if (!holds) throw Bad_argument(requirement);
}

/// An option that not every mode takes.
struct Mode_option {
  const char* name;
  bool is_default;
};

/// They would otherwise be ignored silently.
/// @param modes  that take them
void refuse(std::initializer_list<Mode_option> options, const char* modes) {
  for (const auto& [name, is_default] : options)
    if (!is_default) throw Bad_argument(std::string(name) + " needs the mode " + modes);
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
  if (!finds_all(options.mode))
    refuse({{"tolerance", exact.tolerance == 0},
            {"self_tolerance", exact.self_tolerance == 0},
            {"self_collision", !exact.self_collision},
            {"containment", !exact.containment},
            {"parting", !exact.parting},
            {"patches", !exact.patches},
            {"loosest", exact.loosest == defaults.exact.loosest}},
           "exact or certified");
  if (options.mode != Mode::certified) refuse({{"throw_if_broken", !exact.throw_if_broken}}, "certified");
  if (finds_all(options.mode))
    refuse({{"collision_distance", options.collision_distance == defaults.collision_distance},
            {"distance_measure", options.distance_measure == defaults.distance_measure},
            {"candidates", options.candidates == defaults.candidates},
            {"close_seams", options.close_seams},
            {"least_particles", options.least_particles == defaults.least_particles}},
           "particles or senin");
  if (options.mode != Mode::particles)
    refuse({{"meetings", options.meetings == defaults.meetings},
            {"opening_budget", options.opening_budget == defaults.opening_budget},
            {"opening_reach", options.opening_reach == defaults.opening_reach},
            {"growth", options.growth == defaults.growth}},
           "particles");
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
