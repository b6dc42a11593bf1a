// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "io/mesh_samples.h"
#include "io/temporary_folder.h"
#include "lodestone/errors.h"
#include "lodestone/io/mesh_file.h"

namespace lodestone::test {
namespace {

/// Damages files at random: bytes, digits, lengths. The seed is fixed, so that a failure can be repeated.
class Vandal {
 public:
  std::string damaged(std::string bytes) {
    for (std::size_t blows = 1 + random_() % 4; blows > 0 && !bytes.empty(); --blows) hit(bytes);
    return bytes;
  }

 private:
  void hit(std::string& bytes) {
    const auto at = random_() % bytes.size();
    switch (random_() % 5) {
      case 0:
        bytes[at] = static_cast<char>(random_());
        break;
      case 1:
        bytes.resize(at);
        break;
      case 2:
        bytes.insert(at, bytes.substr(random_() % bytes.size(), random_() % 20));
        break;
      case 3:
        bytes.erase(at, random_() % 20);
        break;
      default:
        replace_number(bytes, at);
    }
  }

  void replace_number(std::string& bytes, std::size_t from) {
    const std::vector<std::string> numbers = {"-1",  "0",   "4294967296", "1e999", "2147483648", "99999999999999999999",
                                              "nan", "1.5", "-0",         "",      "255",        "3 3"};
    const auto at = bytes.find_first_of("0123456789", from);
    if (at != std::string::npos) bytes.replace(at, 1, numbers[random_() % numbers.size()]);
  }

  std::mt19937 random_{2006};
};

TEST(Mesh_damage, any_damage_gives_a_mesh_or_an_error_of_one_line) {
  const Temporary_folder folder;
  Vandal vandal;
  std::size_t meshes = 0, errors = 0;
  for (int round = 0; round < 700; ++round)
    for (const auto& [name, bytes] : all_squares()) {
      const auto file = folder.write(name, vandal.damaged(bytes));
      try {
        EXPECT_TRUE(read_mesh(file).mesh.is_valid(false));
        ++meshes;
      } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        ++errors;
      }
    }
  EXPECT_GT(meshes, 100U) << "the damage is too great to try what is behind the guard";
  EXPECT_GT(errors, 100U);
}

}  // namespace
}  // namespace lodestone::test
