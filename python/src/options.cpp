// SPDX-License-Identifier: GPL-3.0-or-later
#include "options.h"

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <map>
#include <utility>
#include <vector>

#include "lodestone/mesh/errors.h"
#include "lodestone/partition/strategies.h"

namespace lodestone::python {

namespace {

/// Sets one option from a value.
using Set_option = std::function<void(const std::string& name, const py::handle& value)>;
using Option_table = std::map<std::string, Set_option>;

template <class Value>
constexpr const char* type_name = "a number";
template <>
constexpr const char* type_name<std::size_t> = "an integer >= 0";
template <>
constexpr const char* type_name<bool> = "True or False";
template <>
constexpr const char* type_name<std::string> = "a text";

/// A bool of Python or numpy, whose name there depends on its version.
bool is_bool(const py::handle& value) {
  const auto name = py::type::of(value).attr("__name__").cast<std::string>();
  return name == "bool" || name == "bool_";
}

template <class Value>
Set_option to(Value& option) {
  return [&option](const std::string& name, const py::handle& value) {
    try {
      // numpy's numbers and bools pass too; True is no number of threads, and 2 is no yes.
      if (is_bool(value) != std::is_same_v<Value, bool>) throw py::cast_error();
      option = value.cast<Value>();
    } catch (const py::cast_error&) {
      throw py::type_error("the option " + name + " must be " + type_name<Value> + ", but is " +
                           py::repr(value).cast<std::string>());
    }
  };
}

template <class Choice>
Set_option to_one_of(Choice& option, std::initializer_list<std::pair<const char*, Choice>> choices) {
  return [&option, choices = std::vector(choices)](const std::string& name, const py::handle& value) {
    const std::string asked = py::str(value);
    std::string names;
    for (const auto& [choice, meaning] : choices) {
      if (asked == choice) {
        option = meaning;
        return;
      }
      names += (names.empty() ? "" : ", ") + std::string(choice);
    }
    throw Bad_argument("the option " + name + " must be one of " + names + ", but is " +
                       py::repr(value).cast<std::string>());
  };
}

void add_lbg(Option_table& table, Lbg_options& lbg) {
  table["normal_weight"] = to(lbg.features.normal_weight);
  table["lbg_split"] = to_one_of(
      lbg.split_rule, {{"principal_axis", Split::principal_axis}, {"multiplicative", Split::multiplicative}});
  table["lbg_epsilon"] = to(lbg.split);
  table["lbg_tolerance"] = to(lbg.tolerance);
  table["lbg_sample"] = to(lbg.sample);
}

constexpr std::pair<const char*, Lbg_setting> lbg_settings[] = {{"normal_weight", Lbg_setting::normal_weight},
                                                                {"lbg_split", Lbg_setting::split_rule},
                                                                {"lbg_epsilon", Lbg_setting::split},
                                                                {"lbg_tolerance", Lbg_setting::tolerance},
                                                                {"lbg_sample", Lbg_setting::sample}};

void refuse_if_ignored(const Given_strategy& strategy, const py::kwargs& keywords, const char* name,
                       Lbg_setting setting) {
  if (!keywords.contains(name) || (!strategy.function && strategy_reads(strategy.name, setting))) return;
  std::string readers;
  for (const auto reader : strategies_that_read(setting))
    readers += (readers.empty() ? "" : ", ") + std::string(reader);
  throw Bad_argument(std::string("the option ") + name + " is for the strategies " + readers + ": the strategy " +
                     strategy.name + " ignores it");
}

/// Refuses what the strategy would ignore: a function ignores all of it.
/// @param threads  whether `threads` concerns nothing but the strategy
void refuse_settings_of_other_strategies(const Given_strategy& strategy, const py::kwargs& keywords, bool threads) {
  const bool is_known =
      strategy.function || std::ranges::find(strategies(), strategy.name, &Strategy_entry::name) != strategies().end();
  if (!is_known) return;  // the strategy is refused when it is made
  for (const auto& [name, setting] : lbg_settings) refuse_if_ignored(strategy, keywords, name, setting);
  if (threads) refuse_if_ignored(strategy, keywords, "threads", Lbg_setting::threads);
}

/// Mode `senin` divides nothing.
void refuse_strategy_of_senin(const py::kwargs& keywords) {
  std::vector<const char*> names{"strategy", "keep_islands"};
  for (const auto& [name, setting] : lbg_settings) names.push_back(name);
  for (const char* name : names)
    if (keywords.contains(name))
      throw Bad_argument(std::string("the option ") + name +
                         " is for the modes exact, certified, particles: the mode senin ignores it");
}

/// Options that another option makes useless. What one mode lacks, the detector itself refuses.
void refuse_options_without_effect(const Detector_options& options, const py::kwargs& keywords) {
  if (keywords.contains("most_contacts") && options.contacts != Contact_query::all)
    throw Bad_argument("the option most_contacts needs contacts='all': otherwise one contact is listed at most");
  for (const char* name : {"opening_budget", "opening_reach"})
    if (keywords.contains(name) && options.mode == Mode::particles && options.meetings == 0)
      throw Bad_argument(std::string("the option ") + name + " has no effect without meetings");
}

/// Whether the caller chose a strategy or one of its settings, or how regions are repaired.
bool chooses_strategy(const py::kwargs& keywords) {
  return keywords.contains("strategy") || keywords.contains("seed") || keywords.contains("keep_islands") ||
         std::ranges::any_of(lbg_settings, [&](const auto& setting) { return keywords.contains(setting.first); });
}

void set_all(const Option_table& table, const py::kwargs& keywords) {
  for (const auto& [key, value] : keywords) {
    const auto name = key.cast<std::string>();
    const auto found = table.find(name);
    if (found == table.end()) {
      std::string names;
      for (const auto& [known, set] : table) names += (names.empty() ? "" : ", ") + known;
      throw py::type_error("there is no option " + name + "; there are " + names);
    }
    found->second(name, value);
  }
}

}  // namespace

Detector_settings detector_settings(const py::kwargs& keywords) {
  Detector_settings settings;
  auto& options = settings.options;
  auto& exact = options.exact;
  Option_table table{
      {"mode", to_one_of(options.mode, {{"exact", Mode::exact},
                                        {"certified", Mode::certified},
                                        {"particles", Mode::particles},
                                        {"senin", Mode::senin}})},
      {"contacts", to_one_of(options.contacts, {{"all", Contact_query::all},
                                                {"first", Contact_query::first},
                                                {"yes_no", Contact_query::yes_no}})},
      {"contact_points", to(options.contact_points)},
      {"contact_normals", to(options.contact_normals)},
      {"most_contacts", to(options.most_contacts)},
      {"tolerance", to(exact.tolerance)},
      {"self_collision", to(exact.self_collision)},
      {"self_tolerance", to(exact.self_tolerance)},
      {"containment", to(exact.containment)},
      {"parting", to(exact.parting)},
      {"patches", to(exact.patches)},
      {"threads", to(options.threads)},
      {"throw_if_broken", to(exact.throw_if_broken)},
      {"loosest", to(exact.loosest)},
      {"particles", to(options.particles)},
      {"least_particles", to(options.least_particles)},
      {"keep_islands", to(options.partition.keep_islands)},
      {"meetings", to(options.meetings)},
      {"opening_budget", to(options.opening_budget)},
      {"opening_reach", to(options.opening_reach)},
      {"collision_distance", to(options.collision_distance)},
      {"distance_measure", to_one_of(options.distance_measure,
                                     {{"adjacent_vertices", Distance_measure::adjacent_vertices},
                                      {"all_vertices", Distance_measure::all_vertices}})},
      {"candidates", to_one_of(options.candidates,
                               {{"all", Candidate_choice::all}, {"closest", Candidate_choice::closest}})},
      {"list_candidates", to(options.list_candidates)},
      {"close_seams", to(options.close_seams)},
      {"growth", to(options.growth)},
      {"strategy", [&settings](const std::string&, const py::handle& value) { settings.strategy = given_strategy(value); }},
      {"seed", to(settings.strategy_settings.seed)},
  };
  add_lbg(table, settings.strategy_settings.lbg);
  set_all(table, keywords);
  if (options.mode == Mode::senin) refuse_strategy_of_senin(keywords);
  refuse_options_without_effect(options, keywords);
  refuse_settings_of_other_strategies(settings.strategy, keywords, false);  // threads share frames too
  // A caller who chooses a strategy wants regions.
  if (finds_all(options.mode) && chooses_strategy(keywords) && options.particles == 0)
    options.particles = Detector_options().least_particles;
  options.senin.seed = settings.strategy_settings.seed;
  settings.strategy_settings.lbg.threads = options.threads;
  // Wrong settings are refused also where nothing is divided.
  if (!settings.strategy.function) make_strategy(settings.strategy.name, settings.strategy_settings);
  return settings;
}

Partition_settings partition_settings(const py::object& strategy, const py::kwargs& keywords) {
  Partition_settings settings{.strategy = given_strategy(strategy), .strategy_settings = {}, .options = {}};
  Option_table table{{"seed", to(settings.strategy_settings.seed)},
                     {"keep_islands", to(settings.options.keep_islands)},
                     {"threads", to(settings.strategy_settings.lbg.threads)}};
  add_lbg(table, settings.strategy_settings.lbg);
  set_all(table, keywords);
  refuse_settings_of_other_strategies(settings.strategy, keywords, true);
  return settings;
}

}  // namespace lodestone::python
