// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/frame_tally.h"

#include <array>
#include <concepts>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

namespace lodestone {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array stages{&Stage_times::build,       &Stage_times::repartition, &Stage_times::refit,
                            &Stage_times::broad_phase, &Stage_times::relaxation,  &Stage_times::candidates,
                            &Stage_times::confirmation};
constexpr std::array counts{
    &Frame_statistics::iterations,    &Frame_statistics::moves,         &Frame_statistics::meetings,
    &Frame_statistics::vertices_read, &Frame_statistics::nodes_bounded, &Frame_statistics::leaves_posed,
    &Frame_statistics::violations,    &Frame_statistics::candidates,    &Frame_statistics::leaf_tests,
    &Frame_statistics::exact_tests,   &Frame_statistics::builds,        &Frame_statistics::repartitions};

/// Numbers of another kind are not converted: a large one would be undefined behaviour.
template <std::unsigned_integral Number = std::uint64_t>
Number count_of(const Json& json, Number most = std::numeric_limits<Number>::max()) {
  const auto number = json.get_ref<const Json::number_unsigned_t&>();
  if (number > most) throw Json::out_of_range::create(406, std::to_string(number) + " is too large", &json);
  return static_cast<Number>(number);
}

Object_pair object_pair_of(const Json& json) {
  return {count_of<Object_id>(json.at(0)), count_of<Object_id>(json.at(1))};
}

Json pair_json(const Pair_result& pair) {
  return {pair.a,
          pair.b,
          pair.collides,
          pair.near,
          pair.contacts,
          pair.capped,
          static_cast<int>(pair.containment),
          pair.parting ? Json(pair.parting->length) : Json(),
          pair.unfinished};
}

/// JSON has no infinity, which a distance of huge coordinates can be.
double distance_of(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>();
}

Pair_result pair_of(const Json& json) {
  const auto [a, b] = object_pair_of(json);
  Pair_result pair{.a = a, .b = b, .collides = json.at(2), .near = json.at(3)};
  pair.contacts = count_of(json.at(4));
  pair.capped = json.at(5);
  pair.containment = static_cast<Containment>(count_of(json.at(6), static_cast<std::uint64_t>(Containment::b_in_a)));
  if (!json.at(7).is_null()) pair.parting.emplace().length = json.at(7);
  pair.unfinished = json.at(8);
  return pair;
}

}  // namespace

Json to_json(const Frame_tally& tally) {
  Json pairs = Json::array(), seconds = Json::array(), counted = Json::array();
  for (const auto& pair : tally.pairs) pairs.push_back(pair_json(pair));
  for (const auto stage : stages) seconds.push_back(tally.statistics.seconds.*stage);
  for (const auto count : counts) counted.push_back(tally.statistics.*count);
  Json json{{"frame", tally.frame}, {"pairs", std::move(pairs)}, {"seconds", seconds}, {"counts", counted}};
  for (const auto& [pair, truth, seen] : tally.scores) json["scores"].push_back({pair.a, pair.b, truth, seen});
  for (const auto& [pair, distance] : tally.distances) json["distances"].push_back({pair.a, pair.b, distance});
  for (const auto& [pair, time] : tally.impacts) json["impacts"].push_back({pair.a, pair.b, time});
  if (tally.contradicted) json["contradicted"] = true;
  if (tally.missed) json["missed"] = true;
  return json;
}

Frame_tally frame_tally_of(const Json& json) {
  Frame_tally tally{.frame = count_of(json.at("frame"))};
  for (const auto& pair : json.at("pairs")) tally.pairs.push_back(pair_of(pair));
  for (std::size_t i = 0; i < stages.size(); ++i) tally.statistics.seconds.*stages[i] = json.at("seconds").at(i);
  for (std::size_t i = 0; i < counts.size(); ++i) tally.statistics.*counts[i] = count_of(json.at("counts").at(i));
  for (const auto& score : json.value("scores", Json::array()))
    tally.scores.push_back({object_pair_of(score), score.at(2), score.at(3)});
  for (const auto& least : json.value("distances", Json::array()))
    tally.distances.push_back({object_pair_of(least), distance_of(least.at(2))});
  for (const auto& impact : json.value("impacts", Json::array()))
    tally.impacts.push_back({object_pair_of(impact), impact.at(2)});
  tally.contradicted = json.value("contradicted", false);
  tally.missed = json.value("missed", false);
  return tally;
}

}  // namespace lodestone
