// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "lodestone/partition/lbg.h"

/// Every strategy of the library by name, for programs that choose one at run time.
namespace lodestone {

/// Settings for any strategy; each uses those that concern it.
struct Strategy_settings {
  std::uint64_t seed = 1;  ///< of strategies that draw at random
  Lbg_options lbg = {};    ///< of `lbg` and its kin; k-means++ has its features, tolerance and iterations, too
};

/// A setting in `Strategy_settings::lbg` that some strategies ignore.
enum class Lbg_setting {
  normal_weight,  ///< `Feature_options::normal_weight`
  split_rule,     ///< `Lbg_options::split_rule`
  split,          ///< `Lbg_options::split`
  tolerance,      ///< `Lbg_options::tolerance`
  sample,         ///< `Lbg_options::sample`
  threads,        ///< `Lbg_options::threads`
};

/// A partition strategy chosen at run time.
class Any_strategy {
 public:
  /// Labels a surface by index: `label` of some strategy.
  using Label = std::function<Labelling(const Numbered_surface&, std::size_t regions)>;

  /// LBG with default options.
  Any_strategy() : Any_strategy(Lbg{}) {}
  /// Takes a strategy of any type.
  /// @param strategy  one that needs no more than the surface by index
  template <Labels_by_index Strategy>
  explicit Any_strategy(Strategy strategy)
      : name(Strategy::name),
        is_concurrent(lodestone::is_concurrent(strategy)),
        label_([strategy = std::move(strategy)](const Numbered_surface& surface, std::size_t n) {
          return strategy.label(surface, n);
        }) {}

  /// See Partition_strategy.
  template <Triangle_mesh Mesh>
  Labelling operator()(const Partition_input<Mesh>& input, std::size_t regions) const {
    return label(input.surface(), regions);
  }
  /// The same for a surface by index.
  Labelling label(const Numbered_surface& surface, std::size_t regions) const { return label_(surface, regions); }

  std::string_view name;  ///< of the strategy that was chosen
  bool is_concurrent;     ///< whether that one is

 private:
  Label label_;
};

/// An entry of the registry.
struct Strategy_entry {
  std::string_view name;                                    ///< as `make_strategy` takes it
  std::string_view summary;                                 ///< what a region is, in a few words
  Any_strategy (*make)(const Strategy_settings& settings);  ///< makes the strategy
  std::size_t most_vertices;                                ///< with more vertices the strategy throws Bad_argument
  std::span<const Lbg_setting> reads = {};                  ///< settings of LBG; all strategies accept a seed
};

/// All strategies, `lbg` first.
std::span<const Strategy_entry> strategies();

/// Whether the strategy of a name reads a setting; false if there is none of that name.
bool strategy_reads(std::string_view strategy, Lbg_setting setting);
/// The names of those that read a setting.
std::vector<std::string_view> strategies_that_read(Lbg_setting setting);

/// The strategy of a name, with these settings.
/// @throws Bad_argument  there is no strategy of that name
Any_strategy make_strategy(std::string_view name, const Strategy_settings& settings = {});

}  // namespace lodestone
