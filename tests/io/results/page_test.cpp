// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/results/page.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "lodestone/mesh/errors.h"
#include "support/page_decoder.h"
#include "support/read_file.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

using Json = nlohmann::json;

const std::vector<Corners> tetrahedron_faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

/// Points that move, each on its own curve.
std::vector<Positions> moving_points(Eigen::Index vertices, std::size_t frames) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  Positions start(vertices, 3), way(vertices, 3);
  for (auto* const values : {&start, &way})
    for (Eigen::Index i = 0; i < values->size(); ++i) values->data()[i] = anywhere(random);
  std::vector<Positions> result;
  for (std::size_t f = 0; f < frames; ++f) result.emplace_back(start + way * std::sin(0.3 * static_cast<double>(f)));
  return result;
}

/// A page of one object with these positions and one face.
Page page_of(const std::vector<Positions>& frames) {
  Page page({.title = "points"});
  page.add_object("object", static_cast<std::uint32_t>(frames.at(0).rows()), {{0, 1, 2}});
  for (const auto& positions : frames) page.add_frame({.positions = {positions}});
  return page;
}

/// Every coordinate must be decoded within half a step of its object's box, up to a few roundings.
void expect_positions(const std::vector<Positions>& frames) {
  const Decoded_page page(page_of(frames).data());
  const auto decoded = page.positions(0);
  ASSERT_EQ(decoded.size(), frames.size());
  const auto box = page.object(0)["box"].get<std::array<double, 6>>();
  for (int axis = 0; axis < 3; ++axis) {
    double low = frames[0](0, axis), high = low;
    for (const auto& positions : frames) {
      low = std::min(low, positions.col(axis).minCoeff());
      high = std::max(high, positions.col(axis).maxCoeff());
    }
    EXPECT_EQ(box[axis], low);
    EXPECT_EQ(box[3 + axis], high);
    const double half_step = (high / 2 - low / 2) / 65535;
    const double rounding = 4e-16 * std::max(std::abs(low), std::abs(high)) + 1e-323;
    for (std::size_t f = 0; f < frames.size(); ++f)
      for (Eigen::Index v = 0; v < frames[f].rows(); ++v)
        ASSERT_LE(std::abs(decoded[f][3 * v + axis] - frames[f](v, axis)), half_step * (1 + 1e-9) + rounding)
            << "frame " << f << ", vertex " << v << ", axis " << axis;
  }
}

TEST(Page, positions_come_back_within_half_a_step) {
  for (const std::size_t frames : {1, 2, 3, 20}) expect_positions(moving_points(50, frames));
}

TEST(Page, positions_of_any_size_come_back) {
  const auto frames = moving_points(20, 4);
  for (const double scale : {std::ldexp(1, 300), std::ldexp(1, -300), 1e-322, 1e307}) {
    SCOPED_TRACE(scale);
    auto scaled = frames;
    for (auto& positions : scaled) positions *= scale;
    expect_positions(scaled);
  }
}

TEST(Page, positions_far_from_the_origin_come_back) {
  auto frames = moving_points(20, 4);
  for (auto& positions : frames) positions.rowwise() += Eigen::RowVector3d(1e9, -1e12, 1e15);
  expect_positions(frames);
}

TEST(Page, positions_over_the_whole_range_of_doubles_come_back) {
  constexpr double most = std::numeric_limits<double>::max();
  Positions positions(3, 3);
  positions << -most, most, 0, most, -most, most / 3, most / 7, 1, -most / 5;
  std::vector<Positions> frames(2, positions);
  frames[1] *= -1;
  expect_positions(frames);
}

TEST(Page, flat_and_still_objects_come_back_exactly_along_flat_axes) {
  auto frames = moving_points(20, 3);
  for (auto& positions : frames) positions.col(1).setConstant(0.1);
  expect_positions(frames);
  for (const auto& positions : Decoded_page(page_of(frames).data()).positions(0))
    for (std::size_t v = 0; v < 20; ++v) EXPECT_DOUBLE_EQ(positions[3 * v + 1], 0.1);
  expect_positions({Positions::Constant(3, 3, 7), Positions::Constant(3, 3, 7)});
}

/// Corners, as varints of one and of two bytes: differences 0, 1, 1, 198, -200, 1; stored 0, 2, 2, 396, 399, 2.
TEST(Page, the_bytes_of_a_topology_follow_the_format) {
  Page page({.title = ""});
  page.add_object("object", 300, {{0, 1, 2}, {200, 0, 1}});
  page.add_frame({.positions = {Positions::Zero(300, 3)}});
  const Decoded_page decoded(page.data());
  EXPECT_EQ(decoded.section(decoded.object(0)["topology"]), std::string("\x00\x02\x02\x8c\x03\x8f\x03\x02", 8));
  EXPECT_EQ(decoded.topology(0), (std::vector<std::uint32_t>{0, 1, 2, 200, 0, 1}));
}

/// One coordinate alternates between the steps 0 and 65535 in three frames; the others stay at 0.
TEST(Page, the_bytes_of_positions_follow_the_format) {
  Positions here = Positions::Zero(2, 3), there = here;
  there(1, 0) = 2;
  Page page({.title = ""});
  page.add_object("object", 2, {{0, 1, 0}});
  for (const auto* positions : {&there, &here, &there}) page.add_frame({.positions = {*positions}});
  const Decoded_page decoded(page.data());
  // 65535 is stored as 131070, -65535 as 131069, and 65535 - (2 * 0 - 65535) as 262140.
  const std::string expected = std::string("\0\0\0\xfe\xff\x07\0\0", 8) + std::string("\0\0\0\xfd\xff\x07\0\0", 8) +
                               std::string("\0\0\0\xfc\xff\x0f\0\0", 8);
  EXPECT_EQ(decoded.section(decoded.object(0)["positions"]), expected);
}

/// Two objects that differ in everything, three frames.
Page full_page() {
  Page page({.kind = Page_kind::detect,
             .title = "two <objects>",
             .mode = "particles",
             .strategy = "lbg",
             .first_frame = 4,
             .frame_step = 2,
             .frames_per_second = 25,
             .note = "of \"all\" frames"});
  page.add_object("first", 5, {{0, 1, 2}, {2, 3, 4}});
  page.add_object("second", 4, tetrahedron_faces);
  const auto first = moving_points(5, 3), second = moving_points(4, 3);
  page.set_regions(0, {0, 0, 1, 1, 2});
  page.set_regions(1, {0, 0, 0, 0});
  for (std::uint32_t f = 0; f < 3; ++f) {
    page.set_regions(0, f < 2 ? std::vector<Region_index>{0, 0, 1, 1, 2} : std::vector<Region_index>{1, 0, 0, 1, 1});
    page.add_frame(
        {.positions = {first[f], second[f]},
         .particles = {f < 2 ? std::vector<std::uint32_t>{f, 2, 4} : std::vector<std::uint32_t>{0, 1}, {3 - f}},
         .numbers = fmt::format("{{\"frame\": {}}}\n", 4 + 2 * f),
         .stages = R"({"positive": true})",
         .candidates = std::vector<Candidate_regions>(f, {.a = 0, .region_a = 2, .b = 1, .distance = 0.5}),
         .contacts = std::vector<Page_contact>{}});
  }
  return page;
}

TEST(Page, all_parts_of_a_page_come_back) {
  const Decoded_page page(full_page().data());
  page.expect_packed();
  const auto& header = page.header;
  EXPECT_EQ(header["kind"], "detect");
  EXPECT_EQ(header["title"], "two <objects>");
  EXPECT_EQ(header["mode"], "particles");
  EXPECT_EQ(header["strategy"], "lbg");
  EXPECT_EQ(header["frames"], 3);
  EXPECT_EQ(header["first_frame"], 4);
  EXPECT_EQ(header["frame_step"], 2);
  EXPECT_EQ(header["frames_per_second"], 25);
  EXPECT_EQ(header["note"], "of \"all\" frames");
  EXPECT_EQ(header["plots"], Json::array());
  EXPECT_EQ(header["report"], nullptr);
  ASSERT_EQ(header["objects"].size(), 2U);
  EXPECT_EQ(page.object(0)["name"], "first");
  EXPECT_EQ(page.object(1)["vertices"], 4);
  EXPECT_EQ(page.topology(0), (std::vector<std::uint32_t>{0, 1, 2, 2, 3, 4}));
  EXPECT_EQ(page.topology(1), (std::vector<std::uint32_t>{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}));
  EXPECT_EQ(page.particles(0), (std::vector<std::vector<std::uint32_t>>{{0, 2, 4}, {1, 2, 4}, {0, 1}}));
  EXPECT_EQ(page.particles(1), (std::vector<std::vector<std::uint32_t>>{{3}, {2}, {1}}));
  EXPECT_EQ(page.section(header["numbers"]), "{\"frame\": 4}\n{\"frame\": 6}\n{\"frame\": 8}\n");
  EXPECT_EQ(page.json_section("stages"), Json(std::vector<Json>(3, {{"positive", true}})));
  EXPECT_EQ(page.json_section("candidates"), Json::parse("[[], [[0,2,1,0,0.5]], [[0,2,1,0,0.5],[0,2,1,0,0.5]]]"));
  EXPECT_EQ(page.json_section("contacts"), Json::parse("[[], [], []]"));
}

TEST(Page, regions_are_stored_once_with_their_first_frame) {
  const Decoded_page page(full_page().data());
  ASSERT_EQ(page.object(0)["partitions"].size(), 2U);
  EXPECT_EQ(page.object(0)["partitions"][0]["frame"], 0);
  EXPECT_EQ(page.object(0)["partitions"][0]["regions"], 3);
  EXPECT_EQ(page.object(0)["partitions"][1]["frame"], 2);
  EXPECT_EQ(page.object(0)["partitions"][1]["regions"], 2);
  EXPECT_EQ(page.labels(0, 0), (std::vector<std::uint32_t>{0, 0, 1, 1, 2}));
  EXPECT_EQ(page.labels(0, 1), (std::vector<std::uint32_t>{1, 0, 0, 1, 1}));
  ASSERT_EQ(page.object(1)["partitions"].size(), 1U);
  EXPECT_EQ(page.labels(1, 0), (std::vector<std::uint32_t>{0, 0, 0, 0}));
}

TEST(Page, regions_set_twice_before_a_frame_are_the_later_ones) {
  Page page({.title = ""});
  page.add_object("object", 3, {{0, 1, 2}});
  page.set_regions(0, {0, 1, 2});
  page.set_regions(0, {0, 0, 0});
  page.add_frame({.positions = {Positions::Zero(3, 3)}});
  const Decoded_page decoded(page.data());
  ASSERT_EQ(decoded.object(0)["partitions"].size(), 1U);
  EXPECT_EQ(decoded.labels(0, 0), (std::vector<std::uint32_t>{0, 0, 0}));
}

TEST(Page, contacts_store_their_segment_without_rounding) {
  Page page({.title = ""});
  page.add_object("object", 3, {{0, 1, 2}});
  const std::array<double, 6> ends{0.1, -std::ldexp(1, 300), std::ldexp(1, -300), 1.0 / 3, 0, 5e-324};
  page.add_frame({.positions = {Positions::Zero(3, 3)},
                  .contacts = {{{.a = 1, .face_a = 7, .b = 2, .face_b = 9, .ends = ends}, {.face_a = 3}}}});
  const auto contacts = Decoded_page(page.data()).json_section("contacts");
  ASSERT_EQ(contacts.size(), 1U);
  ASSERT_EQ(contacts[0].size(), 2U);
  ASSERT_EQ(contacts[0][0].size(), 10U);
  EXPECT_EQ(contacts[0][1], Json::parse("[0, 3, 0, 0]"));
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(contacts[0][0][4 + i].get<double>(), ends[i]);
}

TEST(Page, missing_parts_of_frames_are_null) {
  const Decoded_page page(page_of(moving_points(3, 1)).data());
  for (const char* key : {"mode", "strategy", "numbers", "stages", "candidates", "contacts", "report"})
    EXPECT_EQ(page.header.at(key), nullptr) << key;
  EXPECT_EQ(page.object(0)["particles"], nullptr);
  EXPECT_EQ(page.object(0)["partitions"], Json::array());
}

TEST(Page, of_an_experiment_has_a_report_and_plots_and_no_frame) {
  Page page({.kind = Page_kind::experiment, .title = "why?", .report = "| a |\n| - |\n"});
  page.add_plot({.name = "time", .title = "Time", .description = "of day", .spec = R"({"z": 1, "a": [null]})"});
  const Decoded_page decoded(page.data());
  EXPECT_EQ(decoded.header["kind"], "experiment");
  EXPECT_EQ(decoded.header["frames"], 0);
  EXPECT_EQ(decoded.header["report"], "| a |\n| - |\n");
  EXPECT_EQ(decoded.header["sections"], Json::object());
  EXPECT_EQ(decoded.header["plots"], Json::parse(R"([{"name": "time", "title": "Time", "description": "of day",
                                                      "spec": {"z": 1, "a": [null]}}])"));
}

TEST(Page, names_may_be_any_bytes) {
  const std::string hostile = "</script><script>@LODESTONE_DATA@\"'\\\n\x01";
  Page page({.title = hostile});
  page.add_object(hostile, 3, {{0, 1, 2}});
  page.add_object("\xff\xfe", 3, {{0, 1, 2}});
  page.add_frame({.positions = {Positions::Zero(3, 3), Positions::Zero(3, 3)}});
  const Decoded_page decoded(page.data());
  EXPECT_EQ(decoded.header["title"], hostile);
  EXPECT_EQ(decoded.object(0)["name"], hostile);
  EXPECT_EQ(decoded.object(1)["name"], "\xef\xbf\xbd\xef\xbf\xbd");
}

TEST(Page, the_same_calls_give_the_same_bytes) { EXPECT_EQ(full_page().data(), full_page().data()); }

TEST(Page, large_sections_come_back_whole) {
  expect_positions(moving_points(20'000, 5));
  Page page({.title = ""});
  page.add_object("object", 3, {{0, 1, 2}});
  std::string numbers(3'000'000, 'x');
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<char>(' ' + i * i % 89);
  page.add_frame({.positions = {Positions::Zero(3, 3)}, .numbers = numbers});
  const Decoded_page decoded(page.data());
  EXPECT_TRUE(decoded.section(decoded.header["numbers"]) == numbers);
}

TEST(Page, refuses_inconsistent_input) {
  Page page({.title = ""});
  EXPECT_THROW(page.add_object("object", 3, {{0, 1, 3}}), Bad_argument);
  page.add_object("object", 3, {{0, 1, 2}});
  EXPECT_THROW(page.set_regions(1, {0, 0, 0}), Bad_argument);
  EXPECT_THROW(page.set_regions(0, {0, 0}), Bad_argument);
  EXPECT_THROW(page.add_frame({.positions = {}}), Bad_argument);
  EXPECT_THROW(page.add_frame({.positions = {Positions::Zero(2, 3)}}), Bad_argument);
  EXPECT_THROW(page.add_frame({.positions = {Positions::Zero(3, 3)}, .particles = {{}, {}}}), Bad_argument);
  EXPECT_THROW(page.add_plot({.name = "plot", .title = "", .description = "", .spec = "{"}), Bad_argument);
  for (const double bad : {std::nan(""), HUGE_VAL})
    EXPECT_THROW(page.add_frame({.positions = {Positions::Constant(3, 3, bad)}}), Bad_mesh);
  EXPECT_EQ(page.frames(), 0U);
  page.add_frame({.positions = {Positions::Zero(3, 3)}, .numbers = "1\n"});
  EXPECT_THROW(page.add_frame({.positions = {Positions::Zero(3, 3)}}), Bad_argument);
  EXPECT_THROW(page.add_object("late", 3, {{0, 1, 2}}), Bad_argument);
  EXPECT_EQ(page.frames(), 1U);
}

TEST(Page_frame_step, is_the_smallest_that_keeps_the_page_small) {
  EXPECT_EQ(page_frame_step(300, 3600), 1U);
  EXPECT_EQ(page_frame_step(1, 100'000'000), 1U);
  EXPECT_EQ(page_frame_step(300, 100'000'000), 300U);
  EXPECT_EQ(page_frame_step(0, 0), 1U);
  for (const std::size_t frames : {1, 2, 60, 299, 300, 301})
    for (const std::size_t vertices : {60'000, 500'000, 50'000'000}) {
      const auto held = [&](std::size_t step) { return (frames + step - 1) / step * vertices; };
      const std::size_t step = page_frame_step(frames, vertices);
      EXPECT_LE(held(step), std::max<std::size_t>(5'000'000, vertices));  // always at least one frame
      if (step > 1) {
        EXPECT_GT(held(step - 1), 5'000'000U);
      }
    }
}

TEST(Page_frame_step, follows_a_requested_number_of_frames) {
  EXPECT_EQ(page_frame_step(10, 5, 4), 3U);  // 0, 3, 6, 9
  EXPECT_EQ(page_frame_step(10, 5, 10), 1U);
  EXPECT_EQ(page_frame_step(10, 5, 9), 2U);  // no step of whole frames gives nine
  EXPECT_EQ(page_frame_step(10, 5, 1), 10U);
  EXPECT_EQ(page_frame_step(300, 100'000'000, 300), 1U);
}

class Page_writing : public testing::Test {
 protected:
  std::string written(std::string_view page_template, std::string_view title, std::string_view data) const {
    const auto target = folder.path() / "page.html";
    Atomic_file file(target);
    const std::size_t bytes = write_page(file, page_template, title, data);
    file.commit();
    EXPECT_EQ(bytes, file_size(target));
    return read_bytes(target);
  }

  Temporary_folder folder;
};

TEST_F(Page_writing, data_of_every_length_are_base64) {
  const std::map<std::string, std::string> known{{"", ""},
                                                 {"f", "Zg=="},
                                                 {"fo", "Zm8="},
                                                 {"foo", "Zm9v"},
                                                 {"foob", "Zm9vYg=="},
                                                 {"fooba", "Zm9vYmE="},
                                                 {"foobar", "Zm9vYmFy"}};  // RFC 4648, section 10
  for (const auto& [bytes, text] : known)
    EXPECT_EQ(written("<@LODESTONE_DATA@>", "", bytes), std::string("<").append(text).append(">"));
  for (const std::size_t size : {196'607, 196'608, 196'609, 1'000'000}) {
    std::string bytes(size, '\0');
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(i * i / 7);
    EXPECT_TRUE(from_base64(written("@LODESTONE_DATA@", "", bytes)) == bytes) << size;
  }
}

TEST_F(Page_writing, a_title_stays_text) {
  EXPECT_EQ(written("<title>@LODESTONE_TITLE@</title><h1>@LODESTONE_TITLE@</h1>@LODESTONE_DATA@",
                    "</title><script>alert(\"1\" & '2')</script>", ""),
            "<title>&lt;/title&gt;&lt;script&gt;alert(&quot;1&quot; &amp; &#39;2&#39;)&lt;/script&gt;</title>"
            "<h1>&lt;/title&gt;&lt;script&gt;alert(&quot;1&quot; &amp; &#39;2&#39;)&lt;/script&gt;</h1>");
}

TEST_F(Page_writing, inserted_text_is_not_searched_for_marks) {
  EXPECT_EQ(written("@LODESTONE_TITLE@|@LODESTONE_DATA@|@LODESTONE_TITLE@", "@LODESTONE_DATA@@LODESTONE_TITLE@", "foo"),
            "@LODESTONE_DATA@@LODESTONE_TITLE@|Zm9v|@LODESTONE_DATA@@LODESTONE_TITLE@");
}

TEST_F(Page_writing, a_template_must_have_one_mark_for_the_data) {
  for (const auto* bad : {"", "@LODESTONE_TITLE@", "@LODESTONE_DATA@ @LODESTONE_DATA@", "@LODESTONE_DATA"})
    EXPECT_THROW(written(bad, "title", "data"), Bad_argument);
  EXPECT_EQ(written("@LODESTONE_DATA@", "title", ""), "");
}

}  // namespace
}  // namespace lodestone::test
