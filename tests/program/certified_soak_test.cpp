// SPDX-License-Identifier: GPL-3.0-or-later
#include "certified_soak/certified_soak.h"

#include <gtest/gtest.h>

#include "certified_soak/promised_bodies.h"
#include "lodestone/bounds/displacement_bound.h"

namespace lodestone {
namespace {

/// Promises that nothing moves, and moves.
class Lying_body final : public Random_body {
 public:
  explicit Lying_body(std::unique_ptr<Random_body> truth) : Random_body(truth->mesh()), truth_(std::move(truth)) {}

  Object_id add_to(Detector<>& detector) const override { return truth_->add_to(detector); }
  void promise_to(Detector<>& detector, Object_id id) const override { detector.promise(id, promise_); }
  void move(const Eigen::Vector3d& place, Random& random) override { truth_->move(place, random); }
  const Position_source& positions() const override { return truth_->positions(); }
  std::unique_ptr<Node_bound> bound(const Bounded_object& object) const override {
    return std::make_unique<Node_bound_of<Displacement_bound>>(promise_.bound(object));
  }
  std::optional<Eigen::Isometry3d> placement() const override { return truth_->placement(); }

 private:
  std::unique_ptr<Random_body> truth_;
  Displacement_promise promise_;
};

std::unique_ptr<Random_body> make_lying(const Eigen::Vector3d& centre, std::size_t frequency, Random& random) {
  return std::make_unique<Lying_body>(make_unbounded(centre, frequency, random));
}

TEST(Certified_soak, a_short_run_of_each_kind_finds_no_difference_and_can_be_repeated) {
  for (std::size_t index = 0; index < certified_soak_kinds(); ++index) {
    SCOPED_TRACE(certified_soak_name(index));
    std::size_t last = 0;
    const auto kind = certified_soak(3, index, 100, [&](std::size_t done) { last = done; });
    const auto again = certified_soak(3, index, 100);
    EXPECT_EQ(kind.name, certified_soak_name(index));
    EXPECT_EQ(last, 100U);
    EXPECT_GE(kind.frames, 100U);
    EXPECT_LT(kind.frames, 130U);
    EXPECT_EQ(kind.questions, kind.frames);
    EXPECT_EQ(kind.differences, 0U);
    EXPECT_EQ(kind.violations, 0U);
    EXPECT_EQ(kind.outside, 0U);
    EXPECT_EQ(kind.refused, 0U);
    EXPECT_GT(kind.boxes, kind.frames);
    EXPECT_EQ(again.colliding, kind.colliding);
    EXPECT_EQ(again.partly_read, kind.partly_read);
    EXPECT_EQ(again.boxes, kind.boxes);
  }
}

TEST(Certified_soak, plays_frames_with_and_without_collisions_and_reads_some_in_part) {
  std::size_t frames = 0, colliding = 0, partly_read = 0;
  for (std::size_t index = 0; index < certified_soak_kinds(); ++index) {
    const auto kind = certified_soak(4, index, 48);
    frames += kind.frames, colliding += kind.colliding, partly_read += kind.partly_read;
  }
  EXPECT_GT(colliding, frames / 4);
  EXPECT_LT(colliding, frames * 3 / 4);
  EXPECT_GT(partly_read, frames / 20);
}

TEST(Certified_soak, notices_a_body_that_breaks_its_promise) {
  const auto kind = certified_soak(1, {"lying", make_lying}, 1200);
  EXPECT_GT(kind.outside, kind.boxes / 4);
  EXPECT_GT(kind.violations, 120U);
}

}  // namespace
}  // namespace lodestone
