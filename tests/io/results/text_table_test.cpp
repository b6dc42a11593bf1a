// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <string>

#include "lodestone/io/results/text_table.h"
#include "lodestone/mesh/errors.h"

namespace lodestone::test {
namespace {

TEST(Text_table, aligns_columns_and_numbers_to_the_right) {
  Text_table table({"name", "faces", "recall"});
  table.add({"teapot", "5784", "0.9"});
  table.add({"ball", "80", "-1"});
  EXPECT_EQ(table.text(),
            "| name   | faces | recall |\n"
            "| ------ | ----: | -----: |\n"
            "| teapot |  5784 |    0.9 |\n"
            "| ball   |    80 |     -1 |\n");
}

TEST(Text_table, a_column_with_a_word_is_left_aligned) {
  Text_table table({"particles", "n"});
  table.add({"12", "+3"});
  table.add({"by rule", "3"});
  EXPECT_EQ(table.text(),
            "| particles |   n |\n"
            "| --------- | --: |\n"
            "| 12        |  +3 |\n"
            "| by rule   |   3 |\n");
}

TEST(Text_table, without_rows_is_its_header) {
  EXPECT_EQ(Text_table({"a", "long name"}).text(),
            "| a   | long name |\n"
            "| --- | --------- |\n");
}

TEST(Text_table, an_empty_cell_is_not_a_number) {
  Text_table table({"a"});
  table.add({""});
  EXPECT_EQ(table.text(), "| a   |\n| --- |\n|     |\n");
}

TEST(Text_table, letters_beyond_ascii_keep_the_columns_aligned) {
  Text_table table({"name", "x"});
  table.add({"\xc3\xa9t\xc3\xa9", "a"});  // three letters in five bytes
  table.add({"winter", "b"});
  EXPECT_NE(table.text().find("| \xc3\xa9t\xc3\xa9    | a   |\n"), std::string::npos) << table.text();
  EXPECT_NE(table.text().find("| winter | b   |\n"), std::string::npos) << table.text();
}

TEST(Text_table, refuses_a_row_with_a_wrong_number_of_cells) {
  Text_table table({"a", "b"});
  EXPECT_THROW(table.add({"1"}), Bad_argument);
  EXPECT_THROW(table.add({"1", "2", "3"}), Bad_argument);
  EXPECT_THROW(table.add({}), Bad_argument);
  EXPECT_EQ(table.text(), Text_table({"a", "b"}).text());
}

}  // namespace
}  // namespace lodestone::test
