// SPDX-License-Identifier: GPL-3.0-or-later
#include "frame_log.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace lodestone {

namespace {

using Json = nlohmann::ordered_json;

Json points_json(const Intersection_points& points) {
  Json json = Json::array();
  for (const auto& p : points) json.push_back({p.x(), p.y(), p.z()});
  return json;
}

Json pair_json(const std::vector<std::string>& names, const Frame& frame, const Pair_result& pair,
               Contact_query query) {
  Json json{{"a", names[pair.a]}, {"b", names[pair.b]}, {"collides", pair.collides}};
  if (query != Contact_query::yes_no) {
    json["faces"] = Json::array();
    for (const auto& [a, b] : frame.contacts(pair)) json["faces"].push_back({a, b});
  }
  if (frame.contact_points.empty()) return json;
  json["points"] = Json::array();
  for (std::size_t i = 0; i < pair.contacts; ++i)
    json["points"].push_back(points_json(frame.contact_points[pair.first_contact + i]));
  return json;
}

}  // namespace

std::string json_text(const nlohmann::ordered_json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string frame_line(std::size_t frame, const std::vector<std::string>& names, const Frame& result,
                       Contact_query query, const std::optional<std::vector<Pair_truth>>& truth) {
  Json pairs = Json::array();
  for (const auto& pair : result.pairs) pairs.push_back(pair_json(names, result, pair, query));
  if (truth) {
    for (const auto& real : *truth) {
      const auto listed =
          std::ranges::find_if(result.pairs, [&](const auto& pair) { return pair.a == real.a && pair.b == real.b; });
      if (listed != result.pairs.end())
        pairs[static_cast<std::size_t>(listed - result.pairs.begin())]["truth"] = !real.faces.empty();
      else if (!real.faces.empty())
        pairs.push_back({{"a", names[real.a]}, {"b", names[real.b]}, {"collides", false}, {"truth", true}});
    }
  }
  const auto& statistics = result.statistics;
  const Json line{{"frame", frame},
                  {"pairs", std::move(pairs)},
                  {"statistics",
                   {{"iterations", statistics.iterations},
                    {"moves", statistics.moves},
                    {"relaxed", statistics.relaxed},
                    {"candidates", statistics.candidates},
                    {"exact_tests", statistics.exact_tests},
                    {"contacts", statistics.contacts},
                    {"repartitions", statistics.repartitions}}}};
  return json_text(line);
}

}  // namespace lodestone
