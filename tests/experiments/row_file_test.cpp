// SPDX-License-Identifier: GPL-3.0-or-later
#include "partitions/row_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "lodestone/mesh/errors.h"
#include "support/read_file.h"
#include "support/temporary_folder.h"

namespace lodestone {
namespace {

using Row = Row_file::Row;

struct Rows : ::testing::Test {
  test::Temporary_folder folder;
  std::filesystem::path file = folder.path() / "sub" / "rows.jsonl";

  std::string text() const { return test::read_bytes(file); }
  void append(const std::string& bytes) const { std::ofstream(file, std::ios::binary | std::ios::app) << bytes; }
};

TEST_F(Rows, a_row_is_in_the_file_when_add_returns) {
  Row_file rows(file);
  rows.add(Row{{"id", "a"}, {"x", 1}});
  EXPECT_EQ(text(), "{\"id\":\"a\",\"x\":1}\n");
  EXPECT_TRUE(rows.has("a"));
  EXPECT_FALSE(rows.has("b"));
}

TEST_F(Rows, rows_are_kept_when_the_file_is_opened_again) {
  { Row_file(file).add(Row{{"id", "a"}, {"x", 0.1}}); }
  { Row_file(file).add(Row{{"id", "b"}}); }
  const Row_file rows(file);
  EXPECT_EQ(rows.rows().size(), 2U);
  EXPECT_EQ(rows.rows().at("a")["x"], 0.1);
  EXPECT_EQ(read_rows(file), rows.rows());
}

TEST_F(Rows, a_run_that_is_already_there_is_not_overwritten) {
  Row_file rows(file);
  rows.add(Row{{"id", "a"}, {"x", 1}});
  rows.add(Row{{"id", "a"}, {"x", 2}});
  EXPECT_EQ(rows.rows().at("a")["x"], 1);
  EXPECT_EQ(text(), "{\"id\":\"a\",\"x\":1}\n");
}

TEST_F(Rows, only_a_line_truncated_at_any_byte_is_dropped) {
  { Row_file(file).add(Row{{"id", "a"}, {"x", 1}}); }
  const std::string first = text(), second = "{\"id\":\"b\",\"x\":2}\n";
  for (std::size_t length = 1; length < second.size(); ++length) {
    append(second.substr(0, length));
    EXPECT_EQ(read_rows(file).size(), 1U);
    const Row_file rows(file);
    EXPECT_EQ(rows.rows().size(), 1U);
    EXPECT_EQ(text(), first);
  }
}

TEST_F(Rows, a_broken_line_is_refused_with_its_line_number_and_the_file_is_unchanged) {
  { Row_file(file).add(Row{{"id", "a"}}); }
  for (const std::string line : {"nonsense\n", "[1]\n", "{\"x\":1}\n", "{\"id\":3}\n", "\n"}) {
    std::filesystem::remove(file);
    append("{\"id\":\"a\"}\n" + line);
    const std::string before = text();
    try {
      const Row_file rows(file);
      FAIL() << line;
    } catch (const Bad_argument& error) {
      EXPECT_NE(std::string(error.what()).find("rows.jsonl:2"), std::string::npos) << error.what();
    }
    EXPECT_EQ(text(), before);
  }
}

TEST_F(Rows, only_one_program_at_a_time_opens_the_file) {
  {
    const Row_file rows(file);
    EXPECT_THROW(Row_file{file}, Bad_output);
  }
  EXPECT_NO_THROW(Row_file{file});
}

TEST_F(Rows, a_file_that_cannot_be_created_or_read_is_an_error) {
  std::ofstream(folder.path() / "plain") << "x";
  EXPECT_THROW(Row_file(folder.path() / "plain" / "rows.jsonl"), Bad_output);
  EXPECT_THROW(read_rows(folder.path() / "missing.jsonl"), Bad_argument);
}

}  // namespace
}  // namespace lodestone
