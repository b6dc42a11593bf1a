// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/io/meshes/label_file.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lodestone/mesh/errors.h"
#include "support/read_file.h"
#include "support/temporary_folder.h"

namespace lodestone::test {
namespace {

class Label_file : public testing::Test {
 protected:
  /// What the reader says about a file of labels for four vertices.
  std::string error_of(const std::string& text) const {
    const auto file = folder.write("a.labels", text);
    try {
      read_labels(file, 4);
    } catch (const Bad_mesh& error) {
      return std::string(error.what()).substr(folder.path().string().size() + 1);
    }
    return "no error";
  }

  Temporary_folder folder;
};

TEST_F(Label_file, has_a_line_per_vertex_and_comments) {
  const auto file = folder.write("a.labels", "# two regions\n1\n0\n\n 1 # the tip\r\n0");
  EXPECT_EQ(read_labels(file, 4), (std::vector<Region_index>{1, 0, 1, 0}));
}

TEST_F(Label_file, is_read_back_as_it_was_written) {
  const std::vector<Region_index> labels{2, 0, 1, 1};
  write_labels(folder.path() / "b.labels", labels);
  EXPECT_EQ(read_bytes(folder.path() / "b.labels"), "2\n0\n1\n1\n");
  EXPECT_EQ(read_labels(folder.path() / "b.labels", 4), labels);
}

TEST_F(Label_file, with_a_wrong_number_of_labels_is_refused) {
  EXPECT_EQ(error_of("0\n1\n0\n"), "a.labels: 3 labels, but the mesh has 4 vertices");
  EXPECT_EQ(error_of("0\n1\n0\n1\n\n1\n"), "a.labels:6: more labels than the 4 vertices of the mesh");
  EXPECT_EQ(error_of("# none\n"), "a.labels: 0 labels, but the mesh has 4 vertices");
}

TEST_F(Label_file, with_a_label_that_is_no_region_is_refused) {
  EXPECT_TRUE(error_of("0\nnull\n1\n0\n").starts_with("a.labels:2: ")) << error_of("0\nnull\n1\n0\n");
  for (const std::string label : {"-1", "0.5", "1 1", "4", "99999999999999999999", "0x1", "1,"})
    EXPECT_TRUE(error_of("0\n1\n" + label + "\n0\n").starts_with("a.labels:3: ")) << label;
}

TEST_F(Label_file, with_a_region_without_a_vertex_is_refused) {
  EXPECT_EQ(error_of("0\n2\n0\n3\n"), "a.labels: region 1 has no vertex; the regions go from 0 to 3");
  EXPECT_EQ(error_of("1\n1\n1\n1\n"), "a.labels: region 0 has no vertex; the regions go from 0 to 1");
}

TEST_F(Label_file, that_is_not_there_is_an_error) {
  EXPECT_THROW(read_labels(folder.path() / "none.labels", 4), Bad_mesh);
}

}  // namespace
}  // namespace lodestone::test
