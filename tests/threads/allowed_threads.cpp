// SPDX-License-Identifier: GPL-3.0-or-later
// These tests run as many threads as they ask for, also on a machine with fewer processors.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <memory>

#include "lodestone/mesh/workers.h"

namespace lodestone {
namespace {

constexpr std::size_t allowed_threads = 8;

class Allowed_threads : public testing::Environment {
 public:
  void SetUp() override {
    control_ = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, allowed_threads);
  }
  void TearDown() override { control_.reset(); }

 private:
  std::unique_ptr<tbb::global_control> control_;
};

[[maybe_unused]] const auto* const environment = testing::AddGlobalTestEnvironment(new Allowed_threads);

TEST(Allowed_threads, are_as_many_as_tests_ask_for) {
  for (const std::size_t threads : {2, 5, 8}) EXPECT_EQ(Workers(threads).count(), threads);
}

}  // namespace
}  // namespace lodestone
