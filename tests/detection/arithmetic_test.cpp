// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cfenv>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "lodestone/detector.h"
#include "lodestone/find_collisions.h"
#include "lodestone/find_first_impact.h"
#include "lodestone/io/shapes/shapes.h"

namespace lodestone {
namespace {

/// Asks everything that must be refused in this environment.
/// @param built  a detector in mode `particles` that has been asked in another one
void expect_refused(Detector<>& built) {
  const Surface_mesh a = icosphere(2), b = icosphere(3);
  for (const Mode mode : {Mode::particles, Mode::senin, Mode::exact, Mode::certified}) {
    Detector<> detector({.mode = mode});
    detector.add(a), detector.add(b);
    EXPECT_THROW(detector.detect(), Bad_argument) << name_of(mode);
    EXPECT_THROW(detector.save(0), Bad_argument) << name_of(mode);
  }
  EXPECT_THROW(built.update(), Bad_argument);
  Detector<> not_built(Detector_options{.mode = Mode::particles});
  not_built.add(std::as_const(a));
  EXPECT_THROW(not_built.update(), Bad_argument);
  Detector<> detector;
  detector.add(a), detector.add(b);
  EXPECT_THROW(detector.closest(0, 1), Bad_argument);
  EXPECT_THROW(detector.contains(0, 1), Bad_argument);
  EXPECT_THROW(find_collisions(a, b), Bad_argument);
  EXPECT_THROW(find_self_collisions(a), Bad_argument);
  EXPECT_THROW(find_first_impact(a, b.points(), b, b.points()), Bad_argument);
}

TEST(Arithmetic, of_a_thread_that_rounds_to_nearest_is_taken) {
  const Surface_mesh a = icosphere(2), b = icosphere(3);
  EXPECT_TRUE(find_collisions(a, b).collides);
}

/// A detector in mode `particles` that has been asked.
class Asked {
 public:
  Asked() : mesh_(icosphere(4)) {
    detector_.add(mesh_);
    detector_.detect();
  }
  Detector<>& detector() { return detector_; }

 private:
  Surface_mesh mesh_;
  Detector<> detector_{{.mode = Mode::particles}};
};

TEST(Arithmetic, of_a_thread_that_rounds_otherwise_is_refused) {
  Asked asked;
  for (const int direction : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    ASSERT_EQ(std::fesetround(direction), 0);
    expect_refused(asked.detector());
    std::fesetround(FE_TONEAREST);
  }
  EXPECT_NO_THROW(asked.detector().update());
  EXPECT_NO_THROW(asked.detector().save(0));
}

#ifdef __SSE2__

TEST(Arithmetic, of_a_thread_that_takes_subnormal_numbers_for_zero_is_refused) {
  Asked asked;
  const unsigned before = _mm_getcsr();
  for (const unsigned flag : {0x8000U, 0x0040U, 0x8040U}) {
    _mm_setcsr(before | flag);
    expect_refused(asked.detector());
    _mm_setcsr(before);
  }
}

TEST(Arithmetic, that_was_refused_once_is_taken_when_it_is_mended) {
  const Surface_mesh a = icosphere(2), b = icosphere(3);
  Detector<> detector;
  detector.add(a), detector.add(b);
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | 0x8000U);
  EXPECT_THROW(detector.detect(), Bad_argument);
  _mm_setcsr(before);
  EXPECT_TRUE(detector.detect().collides());
}

#endif

}  // namespace
}  // namespace lodestone
