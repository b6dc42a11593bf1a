// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/results/page_frame.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "lodestone/triangles/triangle_distance.h"

namespace lodestone {

namespace {

using Json = nlohmann::ordered_json;

Json microseconds(const Stage_times& seconds) {
  const auto rounded = [](double s) { return std::round(1e8 * s) / 100; };
  return {{"build", rounded(seconds.build)},
          {"repartition", rounded(seconds.repartition)},
          {"refit", rounded(seconds.refit)},
          {"broad_phase", rounded(seconds.broad_phase)},
          {"relaxation", rounded(seconds.relaxation)},
          {"candidates", rounded(seconds.candidates)},
          {"confirmation", rounded(seconds.confirmation)}};
}

}  // namespace

Intersection_points meeting_points(const Frame& frame, const Pair_result& pair, std::size_t contact,
                                   const Triangle_of_face& triangle_of) {
  const auto [face_a, face_b] = frame.face_pairs[contact];
  const Triangle a = triangle_of(pair.a, face_a), b = triangle_of(pair.b, face_b);
  if (frame.intersects(contact)) return triangle_intersection(a, b);
  const Closest_points nearest = closest_points(a, b);
  return {nearest.a, nearest.b};
}

std::vector<Page_contact> page_contacts(const Frame& frame, const Triangle_of_face& triangle_of) {
  std::vector<Page_contact> contacts;
  for (const auto& pair : frame.pairs)
    for (std::size_t i = pair.first_contact; i < pair.first_contact + pair.contacts; ++i) {
      const Intersection_points points = meeting_points(frame, pair, i, triangle_of);
      const std::size_t sides = points.size() > 2 ? points.size() : 1;
      for (std::size_t side = 0; side < sides; ++side) {
        const Point &from = points[side], &to = points[(side + 1) % points.size()];
        contacts.push_back({.a = pair.a,
                            .face_a = frame.face_pairs[i].a,
                            .b = pair.b,
                            .face_b = frame.face_pairs[i].b,
                            .ends = {{from.x(), from.y(), from.z(), to.x(), to.y(), to.z()}},
                            .apart = !frame.intersects(i)});
      }
    }
  return contacts;
}

std::string page_stages(const Frame& frame, const Page_outcome& outcome) {
  return Json{{"microseconds", microseconds(frame.statistics.seconds)},
              {"positive", outcome.positive},
              {"found", frame.collides()},
              {"near", outcome.with_tolerance ? Json(frame.near()) : Json()},
              {"nearest", outcome.nearest ? Json(*outcome.nearest) : Json()}}
      .dump();
}

}  // namespace lodestone
