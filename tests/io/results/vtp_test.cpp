// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/results/vtp.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lodestone/mesh/errors.h"
#include "support/read_file.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

using Json = nlohmann::json;

/// One cell of each kind over the corners of the unit square, and an array of each type.
Vtp_data square() {
  return {.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.1}, {0, 1, -2.5e-8}},
          .vertices = {{3}},
          .lines = {{0, 2}},
          .polygons = {{0, 1, 2}, {0, 2, 3}},
          .point_data = {{"region", std::vector<std::uint32_t>{0, 7, 4294967295U, 1}},
                         {"particle", std::vector<std::uint8_t>{0, 0, 255, 1}}},
          .cell_data = {{"depth & \"width\" <mm>", std::vector<double>{-1, 0.1, 1e300, 0}}}};
}

class Vtp : public testing::Test {
 protected:
  Temporary_folder folder;
  std::filesystem::path file = folder.path() / "a.vtp";
};

TEST_F(Vtp, is_read_back_by_vtk_number_for_number) {
  write_vtp(file, square());
  const Json found = read_vtk({file}).at(0);
  EXPECT_EQ(found["points"], Json({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.1}, {0, 1, -2.5e-8}}));
  EXPECT_EQ(found["bounds"], Json({0, 1, 0, 1, -2.5e-8, 0.1}));
  EXPECT_EQ(found["vertices"], Json::parse("[[3]]"));
  EXPECT_EQ(found["lines"], Json::parse("[[0, 2]]"));
  EXPECT_EQ(found["polygons"], Json::parse("[[0, 1, 2], [0, 2, 3]]"));
  EXPECT_EQ(found["point_data"], Json({{"region", {0, 7, 4294967295U, 1}}, {"particle", {0, 0, 255, 1}}}));
  EXPECT_EQ(found["cell_data"], Json({{"depth & \"width\" <mm>", {-1, 0.1, 1e300, 0}}}));
}

TEST_F(Vtp, may_be_empty) {
  write_vtp(file, {.point_data = {{"region", std::vector<std::uint32_t>{}}}});
  const Json found = read_vtk({file}).at(0);
  for (const auto* key : {"points", "vertices", "lines", "polygons"}) EXPECT_EQ(found[key], Json::array()) << key;
  EXPECT_EQ(found["point_data"], Json({{"region", Json::array()}}));
}

TEST_F(Vtp, refuses_arrays_of_a_wrong_length_and_cells_with_a_point_out_of_range) {
  auto data = square();
  data.point_data[0].values = std::vector<std::uint32_t>{1, 2, 3};
  EXPECT_THROW(write_vtp(file, data), Bad_argument);
  data = square();
  data.cell_data[0].values = std::vector<double>{1, 2, 3};
  EXPECT_THROW(write_vtp(file, data), Bad_argument);
  data = square();
  data.polygons[1][2] = 4;
  EXPECT_THROW(write_vtp(file, data), Bad_argument);
  EXPECT_FALSE(exists(file));
}

TEST_F(Vtp, lists_of_frames_name_time_and_file) {
  const auto list = folder.write("a.pvd", pvd_text({{0, "frames/a_0.vtp"}, {0.5, "frames/a & b.vtp"}}));
  EXPECT_EQ(read_vtk({list}).at(0), Json::parse(R"([[0.0, "frames/a_0.vtp"], [0.5, "frames/a & b.vtp"]])"));
}

}  // namespace
}  // namespace lodestone::test
