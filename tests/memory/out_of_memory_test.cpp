// SPDX-License-Identifier: GPL-3.0-or-later
// Each allocation of each call of a detector fails once; and calls that are repeated take no more memory.
#include <gtest/gtest.h>

#include <new>
#include <numeric>
#include <thread>
#include <vector>

#include "lodestone/bounds/displacement_bound.h"
#include "lodestone/find_collisions.h"
#include "lodestone/io/shapes/shapes.h"
#include "memory/failing_memory.h"
#include "memory/memory_trial.h"
#include "support/test_meshes.h"

namespace lodestone::test {
namespace {

const auto with_objects = [](Trial& trial) { trial.add_all(); };
const auto after_frames = [](Trial& trial) {
  trial.add_all();
  trial.play(2);
  trial.pose(2);
};
const auto detect = [](Trial& trial) { trial.detector.detect(); };

void expect_to_survive_in_all_modes(const Tried_call& tried) {
  for (const auto& mode : tried_modes()) expect_to_survive(mode, tried);
}
void expect_to_survive_in_exact_modes(const Tried_call& tried) {
  for (const auto& mode : exact_modes()) expect_to_survive(mode, tried);
}
/// A query leaves nothing to be repeated.
void expect_query_to_survive(const std::function<void(Trial&)>& query) {
  for (const auto& mode : plain_modes())
    expect_to_survive(mode, {.before = after_frames, .call = query, .repeated = false});
}

TEST(Out_of_memory, in_the_first_frame_leaves_a_detector_whose_next_frame_is_right) {
  expect_to_survive_in_all_modes({.before = with_objects, .call = detect});
}

TEST(Out_of_memory, in_a_later_frame_leaves_a_detector_whose_next_frame_is_right) {
  expect_to_survive_in_all_modes({.before = after_frames, .call = [](Trial& trial) {
                                    trial.detector.update();
                                    trial.detector.detect();
                                  }});
}

TEST(Out_of_memory, while_an_object_is_added_leaves_the_others) {
  expect_to_survive_in_all_modes({.before =
                                      [](Trial& trial) {
                                        trial.detector.add(std::as_const(trial.third));
                                        trial.detector.detect();
                                      },
                                  .call = [](Trial& trial) { trial.add_second(); },
                                  .after =
                                      [](Trial& trial) {
                                        EXPECT_EQ(trial.detector.size(), 1U);
                                        for (const auto& pair : trial.detector.detect().pairs) EXPECT_EQ(pair.b, 0U);
                                      }});
}

TEST(Out_of_memory, while_an_object_with_maps_is_added_leaves_the_others) {
  for (const auto& mode : tried_modes())
    if (mode.options.mode != Mode::certified)
      expect_to_survive(mode, {.before = [](Trial& trial) { trial.detector.add(trial.third); },
                               .call = [](Trial& trial) { trial.detector.add(trial.second); },
                               .after = [](Trial& trial) { EXPECT_EQ(trial.detector.size(), 1U); },
                               .maps_are_made = true});
}

TEST(Out_of_memory, in_an_update_leaves_a_detector_whose_next_frame_is_right) {
  const auto grown = [](Trial& trial) {
    after_frames(trial);
    scale(trial.first, 2);
  };
  expect_to_survive_in_all_modes({.before = grown, .call = [](Trial& trial) { trial.detector.update(); }});
}

TEST(Out_of_memory, while_positions_are_given_leaves_those_before) {
  expect_to_survive_in_exact_modes({.before = after_frames,
                                    .call = [](Trial& trial) { trial.detector.update(1, positions_of(trial.second)); },
                                    .after = [](Trial& trial) { EXPECT_TRUE(trial.detector.detect().collides()); }});
}

TEST(Out_of_memory, while_an_object_is_rebuilt_leaves_a_detector_whose_next_frame_is_right) {
  const auto rebuild = [](Trial& trial) { trial.detector.rebuild(1); };
  expect_to_survive_in_all_modes({.before = after_frames, .call = rebuild});
  expect_to_survive_in_exact_modes({.before = after_frames, .call = rebuild, .repeated = false});
  expect_to_survive_in_exact_modes({.before = after_frames, .call = [&](Trial& trial) {
                                      rebuild(trial);
                                      trial.detector.detect();
                                    }});
}

TEST(Out_of_memory, while_a_tree_is_mended_leaves_a_detector_whose_next_frame_is_right) {
  for (const auto& mode : exact_modes())
    if (mode.options.mode == Mode::exact)
      expect_to_survive(mode, {.before =
                                   [](Trial& trial) {
                                     after_frames(trial);
                                     append(trial.second, single_triangle());
                                   },
                               .call =
                                   [](Trial& trial) {
                                     const std::vector<std::uint32_t> changed{0, 7};
                                     trial.detector.rebuild(1, Changed_faces{changed});
                                     trial.detector.detect();
                                   }});
}

TEST(Out_of_memory, while_an_object_is_removed_leaves_a_detector_whose_next_frame_is_right) {
  expect_to_survive_in_all_modes({.before =
                                      [](Trial& trial) {
                                        after_frames(trial);
                                        trial.detector.add(std::as_const(trial.third));
                                        trial.detector.ignore(0, 2);
                                        trial.detector.detect();
                                      },
                                  .call =
                                      [](Trial& trial) {
                                        if (trial.detector.has(2)) trial.detector.remove(2);
                                        trial.detector.detect();
                                      }});
}

TEST(Out_of_memory, while_a_pair_is_ignored_leaves_it) {
  expect_to_survive_in_all_modes({.before = after_frames, .call = [](Trial& trial) { trial.detector.ignore(0, 1); }});
}

TEST(Out_of_memory, while_an_object_is_placed_leaves_a_detector_whose_next_frame_is_right) {
  expect_to_survive_in_all_modes({.before = after_frames, .call = [](Trial& trial) {
                                    Eigen::Isometry3d placement = Eigen::Isometry3d::Identity();
                                    placement.translate(Eigen::Vector3d(0, 0.1, 0));
                                    trial.detector.place(1, placement);
                                    trial.detector.detect();
                                  }});
}

TEST(Out_of_memory, while_an_object_is_saved_leaves_a_detector_whose_next_frame_is_right) {
  const auto save = [](Trial& trial) { trial.detector.save(1); };
  expect_to_survive_in_all_modes({.before = after_frames, .call = save, .repeated = false});
  for (const auto& mode : plain_modes())
    expect_to_survive(mode, {.before = with_objects, .call = save, .repeated = false});
}

TEST(Out_of_memory, while_an_object_is_loaded_leaves_a_detector_whose_next_frame_is_right) {
  for (const auto& mode : tried_modes()) {
    Trial saver(mode);
    saver.add_all();
    const auto saved = saver.detector.save(1);
    const auto load = [&](Trial& trial) { trial.detector.load(1, saved); };
    expect_to_survive(mode, {.before = with_objects, .call = load});
    expect_to_survive(mode, {.before = after_frames, .call = load});
  }
}

TEST(Out_of_memory, while_a_motion_is_promised_leaves_a_detector_whose_next_frame_is_right) {
  Displacement_promise promise;
  promise.move(10);
  for (const auto& mode : exact_modes())
    if (mode.options.mode == Mode::certified)
      expect_to_survive(mode, {.before = after_frames, .call = [&](Trial& trial) {
                                 trial.detector.promise(1, promise);
                                 trial.detector.detect();
                               }});
}

TEST(Out_of_memory, in_a_frame_of_one_pair_leaves_a_detector_whose_next_frame_is_right) {
  expect_query_to_survive([](Trial& trial) { trial.detector.detect(0, 1); });
  expect_query_to_survive([](Trial& trial) { trial.detector.detect(1, 1); });
}

TEST(Out_of_memory, in_a_visit_leaves_a_detector_whose_next_frame_is_right) {
  expect_query_to_survive([](Trial& trial) { trial.detector.visit(0, 1, [](Face_pair) { return Visit::go_on; }); });
}

TEST(Out_of_memory, in_a_query_of_two_objects_leaves_a_detector_whose_next_frame_is_right) {
  expect_query_to_survive([](Trial& trial) { trial.detector.closest(0, 1); });
  expect_query_to_survive([](Trial& trial) { trial.detector.within(0, 1, 0.1); });
  expect_query_to_survive([](Trial& trial) { trial.detector.contains(0, 1); });
  expect_query_to_survive([](Trial& trial) { trial.detector.parting(0, 1); });
  expect_query_to_survive([](Trial& trial) {
    const std::vector<Positions> at_rest(trial.detector.size());
    trial.detector.first_impact(at_rest);
    trial.detector.first_impacts(at_rest);
  });
}

TEST(Out_of_memory, in_a_query_of_rays_or_points_leaves_a_detector_whose_next_frame_is_right) {
  const std::vector<Ray> rays{{.origin = {-3, 0.1, 0.05}, .direction = {1, 0, 0}},
                              {.origin = {0.1, 3, 0.05}, .direction = {0, -1, 0.1}}};
  const std::vector<Point> points{Point(0.1, 0.2, 0.1), Point(2, 2, 2)};
  const std::vector<Ray> many(200, rays.front());
  expect_query_to_survive([&](Trial& trial) { trial.detector.first_hits(0, rays); });
  expect_query_to_survive([&](Trial& trial) { trial.detector.first_hits(0, many); });  // makes a Ray_tree
  expect_query_to_survive([&](Trial& trial) {
    const auto held = trial.detector.hold_positions();
    for (const Ray& ray : many) trial.detector.first_hit(0, ray);  // so does the last of these
  });
  expect_query_to_survive([&](Trial& trial) { trial.detector.first_hits(rays); });
  expect_query_to_survive([&](Trial& trial) { trial.detector.all_hits(0, rays.front()); });
  expect_query_to_survive([&](Trial& trial) { trial.detector.closest_points(0, points); });
  expect_query_to_survive([&](Trial& trial) { trial.detector.point_sides(0, points); });
}

/// In a new thread each time, which keeps nothing of earlier calls.
TEST(Out_of_memory, in_one_call_leaves_the_next_one_right) {
  const Surface_mesh a = icosphere(16);
  Surface_mesh b = icosphere(16);
  shift(b, 0.3, 0.01, 0.02);
  const auto expected = find_collisions(a, b).faces;
  std::size_t failures = 0;
  for (bool ran_out = true; ran_out; failures += ran_out ? 1 : 0)
    std::thread([&] {
      fail_allocation(failures);
      try {
        find_collisions(a, b);
      } catch (const std::bad_alloc&) {
      }
      ran_out = allocation_failed();
      fail_allocation(never);
      EXPECT_EQ(find_collisions(a, b).faces, expected);
    }).join();
  EXPECT_GT(failures, 20U);
}

/// The program may ask about an object seldom, or only about others.
TEST(Memory, does_not_grow_with_rebuilds_that_no_query_follows) {
  const auto mesh = icosphere(8), other = icosphere(2);
  std::vector<std::uint32_t> all(mesh.number_of_faces());
  std::iota(all.begin(), all.end(), 0U);
  Detector<> detector;
  detector.add(mesh), detector.add(other);
  const auto found = detector.detect().face_pairs;
  const auto largest_of = [&](std::size_t rebuilds) {
    fail_allocation(never);
    for (std::size_t i = 0; i < rebuilds; ++i) detector.rebuild(0, Changed_faces{all});
    return largest_block();
  };
  const std::size_t of_some = largest_of(5), of_many = largest_of(500);
  EXPECT_LE(of_many, 2 * of_some);
  EXPECT_EQ(detector.detect().face_pairs, found);
}

}  // namespace
}  // namespace lodestone::test
