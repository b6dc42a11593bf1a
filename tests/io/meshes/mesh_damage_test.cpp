// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <string>

#include "lodestone/io/meshes/mesh_file.h"
#include "lodestone/mesh/errors.h"
#include "support/mesh_samples.h"
#include "support/temporary_folder.h"
#include "support/vandal.h"

namespace lodestone::test {
namespace {

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
