// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/partition/strategies.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "lodestone/mesh/errors.h"
#include "lodestone/partition/centroidal.h"
#include "lodestone/partition/farthest_point.h"
#include "lodestone/partition/grid.h"
#include "lodestone/partition/hilbert.h"
#include "lodestone/partition/kmeans_plus_plus.h"
#include "lodestone/partition/lbg_curvature.h"
#include "lodestone/partition/lbg_position.h"
#include "lodestone/partition/median_split.h"
#include "lodestone/partition/metis.h"
#include "lodestone/partition/random_voronoi.h"
#include "lodestone/partition/region_growing.h"
#include "lodestone/partition/sdf.h"
#include "lodestone/partition/spectral.h"
#include "lodestone/partition/vsa.h"

namespace lodestone {

namespace {

constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();

constexpr Lbg_setting settings_of_lbg[] = {Lbg_setting::normal_weight, Lbg_setting::split_rule, Lbg_setting::split,
                                           Lbg_setting::tolerance,     Lbg_setting::sample,     Lbg_setting::threads};
constexpr auto settings_without_normals = std::span(settings_of_lbg).subspan(1);
constexpr Lbg_setting settings_of_kmeans[] = {Lbg_setting::normal_weight, Lbg_setting::tolerance};

template <class Strategy>
Any_strategy from_lbg_options(const Strategy_settings& settings) {
  check(settings.lbg);
  return Any_strategy(Strategy{.options = settings.lbg});
}

template <class Strategy>
Any_strategy from_seed(const Strategy_settings& settings) {
  return Any_strategy(Strategy{.options = {.seed = settings.seed}});
}

template <class Strategy>
Any_strategy from_nothing(const Strategy_settings&) {
  return Any_strategy(Strategy{});
}

Any_strategy lbg_curvature(const Strategy_settings& settings) {
  check(settings.lbg);
  return Any_strategy(Lbg_curvature{.options = {.lbg = settings.lbg}});
}

Any_strategy kmeans_plus_plus(const Strategy_settings& settings) {
  // Stops as `lbg` does, so that the two can be compared.
  const Kmeans_plus_plus_options options{.seed = settings.seed,
                                         .tolerance = settings.lbg.tolerance,
                                         .max_iterations = settings.lbg.max_iterations,
                                         .features = settings.lbg.features};
  check(options);
  return Any_strategy(Kmeans_plus_plus{.options = options});
}

}  // namespace

std::span<const Strategy_entry> strategies() {
  static constexpr auto all = std::to_array<Strategy_entry>({
      {Lbg::name, "cells of position and normal, by splitting and Lloyd iterations", from_lbg_options<Lbg>, any_number,
       settings_of_lbg},
      {Lbg_position::name, "the same of positions alone", from_lbg_options<Lbg_position>, any_number,
       settings_without_normals},
      {Lbg_curvature::name, "the same of position, normal and mean curvature", lbg_curvature, any_number,
       settings_of_lbg},
      {Kmeans_plus_plus::name, "cells of position and normal, by Lloyd iterations from a random start far apart",
       kmeans_plus_plus, any_number, settings_of_kmeans},
      {Farthest_point::name, "vertices nearest along the edges to seeds far apart", from_seed<Farthest_point>,
       any_number},
      {Random_voronoi::name, "vertices nearest along the edges to random seeds", from_seed<Random_voronoi>, any_number},
      {Centroidal::name, "vertices nearest along the edges to seeds in the middle of their cells",
       from_seed<Centroidal>, any_number},
      {Metis::name, "parts of equal size with few edges between them", from_seed<Metis>, any_number},
      {Spectral::name, "halves of halves along the Fiedler vector", from_seed<Spectral>, Spectral::most_vertices},
      {Vsa::name, "areas that are each approximated by a plane, optimised", from_nothing<Vsa>, any_number},
      {Region_growing::name, "nearly flat areas, each grown from one face", from_nothing<Region_growing>, any_number},
      {Sdf::name, "parts of a body, by how thick it is", from_nothing<Sdf>, any_number},
      {Grid::name, "vertices in one cube of a regular grid", from_nothing<Grid>, any_number},
      {Median_split::name, "equally many vertices, by splits along the longest axis", from_nothing<Median_split>,
       any_number},
      {Hilbert::name, "runs of vertices along a Hilbert curve", from_nothing<Hilbert>, any_number},
  });
  return all;
}

bool strategy_reads(std::string_view strategy, Lbg_setting setting) {
  const auto entry = std::ranges::find(strategies(), strategy, &Strategy_entry::name);
  return entry != strategies().end() && std::ranges::find(entry->reads, setting) != entry->reads.end();
}

std::vector<std::string_view> strategies_that_read(Lbg_setting setting) {
  std::vector<std::string_view> names;
  for (const auto& strategy : strategies())
    if (strategy_reads(strategy.name, setting)) names.push_back(strategy.name);
  return names;
}

Any_strategy make_strategy(std::string_view name, const Strategy_settings& settings) {
  const auto entry = std::ranges::find(strategies(), name, &Strategy_entry::name);
  if (entry == strategies().end()) throw Bad_argument("there is no partition strategy '" + std::string(name) + "'");
  return entry->make(settings);
}

}  // namespace lodestone
