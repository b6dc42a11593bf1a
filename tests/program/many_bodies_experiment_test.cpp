// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "program/run_program.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

TEST(Many_bodies_experiment, measures_the_scenes_of_the_given_numbers_of_bodies) {
  const Temporary_folder folder;
  const auto out = folder.path() / "out";
  expect_success(run_program({"experiment", "many_bodies", "--only", "20", "--out", out.string()}));
  EXPECT_EQ(content_of(out), (std::set<std::string>{"many_bodies.json", "many_bodies.md"}));
  const auto figures = read_json(out / "many_bodies.json");
  ASSERT_EQ(figures["rows"].size(), 3U);
  for (const auto& row : figures["rows"]) {
    EXPECT_EQ(row["bodies"], 20);
    EXPECT_EQ(row["frames"], 60 * 190);
    EXPECT_GT(row["meets_per_body"], 0.1);
    EXPECT_EQ(row["precision"], 1.0);
  }
  EXPECT_FALSE(figures.contains("exponents"));
}

TEST(Many_bodies_experiment, fits_an_exponent_per_mode_to_several_numbers_of_bodies) {
  const Temporary_folder folder;
  const auto out = folder.path() / "out";
  expect_success(run_program({"experiment", "many_bodies", "--only", "20,100", "--out", out.string()}));
  const auto figures = read_json(out / "many_bodies.json");
  const auto median = [&](std::size_t row) {
    return figures["rows"].at(row)["median_microseconds"]["without_build"].get<double>();
  };
  const double ratio_of_bodies = 100.0 / 20;
  for (const auto& [mode, row] : {std::pair("particles, 12", 0), {"particles, no meetings, 12", 1}, {"exact", 2}})
    EXPECT_NEAR(figures["exponents"][mode].get<double>(),
                std::log(median(row + 3) / median(row)) / std::log(ratio_of_bodies), 1e-9);
  const auto report = read_bytes(out / "many_bodies.md");
  EXPECT_NE(report.find("Exponent of the median time against the number of bodies: "), std::string::npos) << report;
}

TEST(Many_bodies_experiment, refuses_another_number_of_bodies_and_one_twice) {
  expect_error(run_program({"experiment", "many_bodies", "--only", "20,20"}), 2, "20 is given twice");
  expect_error(run_program({"experiment", "many_bodies", "--only", "21"}), 2,
               "there are scenes of 20, 100, 500 and 2000 bodies, not of 21");
}

}  // namespace
}  // namespace lodestone::test
