// SPDX-License-Identifier: GPL-3.0-or-later
// What a shard tells the summary of one frame.
#include "program/frame_tally.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace lodestone {
namespace {

using Json = nlohmann::ordered_json;

Frame_tally some_tally() {
  Frame_tally tally{.frame = 7};
  tally.pairs.push_back({.a = 0, .b = 2, .collides = true, .near = true, .contacts = 3, .capped = true});
  tally.pairs.push_back({.a = 1, .b = 2, .containment = Containment::b_in_a, .parting = Parting{.length = 0.1}});
  tally.statistics.seconds.refit = 0.25;
  tally.statistics.exact_tests = 12;
  tally.scores.push_back({{0, 1}, true, false});
  tally.distances.push_back({{0, 2}, 1.0 / 3});
  tally.impacts.push_back({{1, 2}, 0.7});
  tally.missed = true;
  return tally;
}

TEST(Frame_tally, survives_being_written) {
  const Json json = to_json(some_tally());
  const Frame_tally tally = frame_tally_of(Json::parse(json.dump()));
  EXPECT_EQ(to_json(tally), json);
  EXPECT_EQ(tally.frame, 7U);
  EXPECT_EQ(tally.pairs.at(1).containment, Containment::b_in_a);
  EXPECT_EQ(tally.pairs.at(1).parting->length, 0.1);
  EXPECT_EQ(tally.distances.at(0).distance, 1.0 / 3);
  EXPECT_EQ(tally.impacts.at(0).pair, (Object_pair{1, 2}));
  EXPECT_EQ(tally.impacts.at(0).time, 0.7);
  EXPECT_TRUE(tally.missed);
  EXPECT_FALSE(tally.contradicted);
}

TEST(Frame_tally, refuses_numbers_that_are_no_counts_of_their_kind) {
  const Json whole = to_json(some_tally());
  const auto refused = [&](const char* pointer, const Json& value) {
    Json json = whole;
    json[Json::json_pointer(pointer)] = value;
    EXPECT_THROW(frame_tally_of(json), Json::exception) << pointer << ' ' << value;
  };
  for (const Json& value : {Json(1e127), Json(-1), Json(0.5), Json("1"), Json()}) {
    refused("/frame", value);
    refused("/pairs/0/0", value);
    refused("/pairs/0/4", value);
    refused("/pairs/0/6", value);
    refused("/counts/3", value);
    refused("/scores/0/1", value);
    refused("/distances/0/0", value);
    refused("/impacts/0/0", value);
  }
  refused("/pairs/0/0", std::uint64_t{1} << 32U);
  refused("/pairs/0/6", 3);
}

}  // namespace
}  // namespace lodestone
