// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/frame_tally.h"

#include <array>
#include <nlohmann/json.hpp>

namespace lodestone {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array stages{&Stage_times::build,       &Stage_times::repartition, &Stage_times::refit,
                            &Stage_times::broad_phase, &Stage_times::relaxation,  &Stage_times::candidates,
                            &Stage_times::confirmation};
constexpr std::array counts{
    &Frame_statistics::iterations,    &Frame_statistics::moves,         &Frame_statistics::meetings,
    &Frame_statistics::vertices_read, &Frame_statistics::nodes_bounded, &Frame_statistics::leaves_posed,
    &Frame_statistics::violations,    &Frame_statistics::candidates,    &Frame_statistics::openings,
    &Frame_statistics::exact_tests,   &Frame_statistics::builds,        &Frame_statistics::repartitions};

Json pair_json(const Pair_result& pair) {
  return {pair.a,
          pair.b,
          pair.collides,
          pair.near,
          pair.contacts,
          pair.capped,
          static_cast<int>(pair.containment),
          pair.parting ? Json(pair.parting->length) : Json()};
}

Pair_result pair_of(const Json& json) {
  Pair_result pair{.a = json.at(0), .b = json.at(1), .collides = json.at(2), .near = json.at(3)};
  pair.contacts = json.at(4);
  pair.capped = json.at(5);
  pair.containment = static_cast<Containment>(json.at(6).get<int>());
  if (!json.at(7).is_null()) pair.parting.emplace().length = json.at(7);
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
  Frame_tally tally{.frame = json.at("frame")};
  for (const auto& pair : json.at("pairs")) tally.pairs.push_back(pair_of(pair));
  for (std::size_t i = 0; i < stages.size(); ++i) tally.statistics.seconds.*stages[i] = json.at("seconds").at(i);
  for (std::size_t i = 0; i < counts.size(); ++i) tally.statistics.*counts[i] = json.at("counts").at(i);
  for (const auto& score : json.value("scores", Json::array()))
    tally.scores.push_back({{score.at(0), score.at(1)}, score.at(2), score.at(3)});
  for (const auto& least : json.value("distances", Json::array()))
    tally.distances.push_back({{least.at(0), least.at(1)}, least.at(2)});
  for (const auto& impact : json.value("impacts", Json::array()))
    tally.impacts.push_back({{impact.at(0), impact.at(1)}, impact.at(2)});
  tally.contradicted = json.value("contradicted", false);
  tally.missed = json.value("missed", false);
  return tally;
}

}  // namespace lodestone
