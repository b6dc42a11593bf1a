// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/results/frame_json.h"

namespace lodestone {

using Json = nlohmann::ordered_json;

nlohmann::ordered_json verdict_json(const std::string& name_a, const std::string& name_b, const Pair_result& pair,
                                    const Detector_options& options) {
  Json json{{"a", name_a}, {"b", name_b}, {"collides", pair.collides}};
  if (tolerance_of(options.exact, {pair.a, pair.b}) > 0) json["near"] = pair.near;
  return json;
}

nlohmann::ordered_json statistics_json(const Frame_statistics& statistics, Mode mode, bool independent) {
  // Whether leaves are posed one by one, and which first, depends on the frames before.
  if (mode == Mode::certified && independent)
    return {{"contacts", statistics.contacts}, {"builds", statistics.builds}, {"rebuilds", statistics.repartitions}};
  if (finds_all(mode)) {
    Json json{{"leaf_tests", statistics.leaf_tests}, {"exact_tests", statistics.exact_tests},
              {"contacts", statistics.contacts},     {"builds", statistics.builds},
              {"rebuilds", statistics.repartitions}, {"vertices_read", statistics.vertices_read}};
    if (mode == Mode::certified) {
      json["nodes_bounded"] = statistics.nodes_bounded;
      json["leaves_posed"] = statistics.leaves_posed;
      json["violations"] = statistics.violations;
    }
    return json;
  }
  return {{"iterations", statistics.iterations},
          {"moves", statistics.moves},
          {"relaxed", statistics.relaxed},
          {"candidates", statistics.candidates},
          {"meetings", statistics.meetings},
          {"leaf_tests", statistics.leaf_tests},
          {"exact_tests", statistics.exact_tests},
          {"contacts", statistics.contacts},
          {"builds", statistics.builds},
          {"repartitions", statistics.repartitions},
          {"vertices_read", statistics.vertices_read}};
}

}  // namespace lodestone
