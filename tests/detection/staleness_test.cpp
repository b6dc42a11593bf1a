// SPDX-License-Identifier: GPL-3.0-or-later
// An answer is never that of an earlier frame, however positions came in.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>

#include "support/exact_truth.h"
#include "support/special_numbers.h"

namespace lodestone {
namespace {

const Detector_options exact_mode{.mode = Mode::exact};

/// The message of the Bad_mesh that `action` throws; empty if it throws nothing.
template <class Action>
std::string refusal(Action action) {
  try {
    action();
  } catch (const Bad_mesh& error) {
    return error.what();
  }
  return {};
}

TEST(Staleness, vertices_that_move_without_an_update_are_seen_by_detect) {
  auto a = potato(8), b = potato(8, 2);
  shift(b, 4);
  Exact_detector detector(exact_mode);
  add_all(detector, {&a, &b});
  std::size_t colliding = 0;
  for (int frame = 0; frame < 12; ++frame) {
    colliding += expect_exhaustive(detector.detect(), {&a, &b});
    shift(b, frame < 6 ? -0.4 : 0.4);
    crumple(a, 0.01, 1);
  }
  EXPECT_GT(colliding, 3U);
  EXPECT_LT(colliding, 12U);
}

TEST(Staleness, vertices_that_move_without_an_update_are_seen_by_a_visitor) {
  auto a = potato(8), b = potato(8, 2);
  Exact_detector detector(exact_mode);
  add_all(detector, {&a, &b});
  EXPECT_THROW(detector.visit(0, 0, [](Face_pair) { return Visit::go_on; }), Bad_argument);
  for (int frame = 0; frame < 5; ++frame) {
    shift(b, 0.5);
    std::vector<Face_pair> found;
    EXPECT_EQ(detector.visit(0, 1,
                             [&](Face_pair pair) {
                               found.push_back(pair);
                               return Visit::go_on;
                             }),
              Visit::go_on);
    std::ranges::sort(found);
    EXPECT_EQ(found, exhaustive_face_pairs(a, b));
  }
}

TEST(Staleness, vertices_that_move_without_an_update_are_seen_by_every_query_of_a_pair) {
  auto a = potato(5), b = sphere(4, 0.3);
  Exact_detector detector(exact_mode);
  add_all(detector, {&a, &b});
  EXPECT_TRUE(detector.contains(0, 1));
  for (const double x : {0.0, 0.9, 1.5, 3.0, 0.2}) {
    const auto start = b;
    shift(b, x);
    const auto truth = exhaustive_face_pairs(a, b);
    // In turns, so that each of them is the first to see the new positions.
    for (int first = 0; first < 3; ++first) {
      if (first == 0) {
        expect_contacts(detector.detect(0, 1), 0, 1, truth);
      }
      if (first == 1) {
        EXPECT_EQ(detector.closest(0, 1).points.distance, distance_of(a, b));
      }
      if (first == 2) {
        EXPECT_EQ(detector.contains(0, 1), x < 1);
      }
      for (const auto v : b.vertices()) b.point(v) = start.point(v);
      detector.detect();
      shift(b, x);
    }
    for (const auto v : b.vertices()) b.point(v) = start.point(v);
  }
}

TEST(Staleness, a_query_of_a_pair_leaves_the_other_objects_to_the_next_frame) {
  auto a = sphere(5), b = sphere(5, 1, {5, 0, 0}), c = sphere(5, 1, {-5, 0, 0});
  Exact_detector detector(exact_mode);
  add_all(detector, {&a, &b, &c});
  EXPECT_FALSE(detector.detect().collides());
  shift(b, -3.5);
  shift(c, 3.5);
  EXPECT_TRUE(detector.detect(0, 1).collides());
  EXPECT_EQ(expect_exhaustive(detector.detect(), {&a, &b, &c}), 2U);
}

TEST(Staleness, given_positions_are_copied) {
  const auto a = potato(6), b = potato(6, 2);
  auto there = b;
  shift(there, 1.3, 0.2);
  const auto truth = exhaustive_face_pairs(a, there);
  ASSERT_FALSE(truth.empty());
  ASSERT_NE(truth, exhaustive_face_pairs(a, b));
  Exact_detector detector(exact_mode);
  add_all(detector, {&a, &b});
  auto given = std::make_unique<Positions>(positions_of(there));
  detector.update(1, *given);
  given->setConstant(not_a_number);
  expect_contacts(detector.detect(), 0, 1, truth);
  given.reset();
  expect_contacts(detector.detect(), 0, 1, truth);
  expect_contacts(detector.detect(0, 1), 0, 1, truth);
}

TEST(Staleness, given_positions_win_over_the_mesh_until_the_next_update) {
  auto a = potato(6), b = potato(6, 2);
  Exact_detector detector(exact_mode);
  add_all(detector, {&a, &b});
  const auto near = [&] {
    auto moved = b;
    shift(moved, 1.5);
    return moved;
  }();
  const auto near_truth = exhaustive_face_pairs(a, near);
  for (const bool all : {false, true}) {
    detector.update(1, positions_of(near));
    for (int frame = 0; frame < 3; ++frame) {
      shift(b, 7);
      expect_contacts(detector.detect(), 0, 1, near_truth);
      EXPECT_FALSE(detector.contains(0, 1));
      EXPECT_EQ(detector.closest(0, 1).points.distance, 0);
    }
    if (all)
      detector.update();
    else
      detector.update(1);
    EXPECT_FALSE(detector.detect().collides());
    shift(b, -21);
    EXPECT_EQ(expect_exhaustive(detector.detect(), {&a, &b}), 1U);
  }
}

TEST(Staleness, positions_may_be_given_before_the_first_frame) {
  const auto a = potato(6), b = potato(6, 2);
  auto there = b;
  shift(there, 1.3, 0.2);
  Exact_detector detector(exact_mode);
  add_all(detector, {&a, &b});
  detector.update(1, positions_of(there));
  expect_contacts(detector.detect(), 0, 1, exhaustive_face_pairs(a, there));
}

TEST(Staleness, positions_may_lie_anywhere_in_memory) {
  const auto a = potato(6), b = potato(6, 2);
  auto there = b;
  shift(there, 1.3, 0.2);
  const auto truth = exhaustive_face_pairs(a, there);
  const Positions rows = positions_of(there);
  const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::ColMajor> columns = rows;
  Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor> wide(rows.rows(), 7);
  wide.setConstant(not_a_number);
  wide.middleCols<3>(2) = rows;
  Eigen::MatrixXd long_columns = Eigen::MatrixXd::Constant(rows.rows() + 9, 5, not_a_number);
  long_columns.block(4, 1, rows.rows(), 3) = rows;
  Positions every_second = Positions::Constant(2 * rows.rows(), 3, not_a_number);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) every_second.row(2 * i) = rows.row(i);
  using Strided = Eigen::Map<const Positions, 0, Eigen::OuterStride<>>;
  Exact_detector detector(exact_mode);
  add_all(detector, {&a, &b});
  const auto check = [&] {
    expect_contacts(detector.detect(), 0, 1, truth);
    detector.update(1);
    EXPECT_NE(detector.detect().face_pairs, truth);
  };
  detector.update(1, rows), check();
  detector.update(1, columns), check();
  detector.update(1, wide.middleCols<3>(2)), check();
  detector.update(1, long_columns.block(4, 1, rows.rows(), 3)), check();
  detector.update(1, Strided(every_second.data(), rows.rows(), 3, Eigen::OuterStride<>(6))), check();
  detector.update(1, (rows.array() + 0.0).matrix()), check();
}

TEST(Staleness, wrong_positions_are_refused_and_the_object_stays_as_it_was) {
  auto a = potato(6), b = potato(6, 2);
  auto there = b;
  shift(there, 1.3, 0.2);
  Exact_detector detector(exact_mode);
  add_all(detector, {&a, &b});
  const Positions rows = positions_of(there);
  for (const bool given : {false, true}) {
    if (given) detector.update(1, rows);
    const auto truth = exhaustive_face_pairs(a, given ? there : b);
    for (const Eigen::Index wrong : {Eigen::Index{0}, Eigen::Index{1}, rows.rows() - 1, rows.rows() + 1}) {
      const Positions bad = Positions::Zero(wrong, 3);
      EXPECT_THROW(detector.update(1, bad), Bad_mesh);
      expect_contacts(detector.detect(), 0, 1, truth);
    }
    for (const double value : {not_a_number, infinity, -infinity})
      for (const Eigen::Index row : {Eigen::Index{0}, Eigen::Index{17}, rows.rows() - 1}) {
        Positions bad = rows;
        bad(row, 1) = value;
        const auto message = refusal([&] { detector.update(1, bad); });
        EXPECT_NE(message.find("vertex " + std::to_string(row) + " "), std::string::npos) << message;
        EXPECT_NE(message.find("object 1"), std::string::npos) << message;
        expect_contacts(detector.detect(), 0, 1, truth);
      }
  }
}

TEST(Staleness, a_coordinate_that_is_not_finite_is_named_and_the_next_frame_is_right) {
  for (const double value : {not_a_number, infinity, -infinity})
    for (const bool first_frame : {true, false}) {
      auto a = potato(6), b = potato(6, 2), c = potato(6, 3);
      shift(b, 2);
      shift(c, -2);
      Exact_detector detector(exact_mode);
      add_all(detector, {&a, &b, &c});
      if (!first_frame) {
        EXPECT_EQ(expect_exhaustive(detector.detect(), {&a, &b, &c}), 2U);
      }
      auto& point = b.point(Surface_mesh::Vertex_index(23));
      const Point before = point;
      point = Point(before.x(), before.y(), value);
      for (const auto& message : {refusal([&] { detector.detect(); }), refusal([&] { detector.detect(0, 1); }),
                                  refusal([&] { detector.closest(1, 0); }), refusal([&] { detector.contains(0, 1); }),
                                  refusal([&] { detector.visit(0, 1, [](Face_pair) { return Visit::go_on; }); })}) {
        EXPECT_NE(message.find("vertex 23 "), std::string::npos) << message;
        EXPECT_NE(message.find("object 1"), std::string::npos) << message;
      }
      shift(a, 0.1);
      shift(c, 0.2);
      expect_contacts(detector.detect(0, 2), 0, 2, exhaustive_face_pairs(a, c));  // does not read it
      point = before;
      shift(b, -0.1);
      EXPECT_EQ(expect_exhaustive(detector.detect(), {&a, &b, &c}), 2U);
    }
}

TEST(Staleness, a_visitor_cannot_change_what_it_is_shown) {
  auto a = potato(6), b = potato(6, 2);
  const auto c = potato(6, 3);
  shift(b, 1.3);
  Exact_detector detector(exact_mode);
  add_all(detector, {&a, &b});
  const auto moved = positions_of(a);
  const std::vector<std::function<void()>> calls{[&] { detector.update(0, moved); }, [&] { detector.update(0); },
                                                 [&] { detector.rebuild(0); },       [&] { detector.detect(); },
                                                 [&] { detector.add(c); },           [&] { detector.closest(0, 1); }};
  for (const auto& call : calls) {
    detector.update(0, moved);
    const Frame& frame = detector.detect();
    const auto number = frame.number;
    EXPECT_THROW(detector.visit(0, 1,
                                [&](Face_pair) {
                                  call();
                                  return Visit::go_on;
                                }),
                 Bad_argument);
    EXPECT_EQ(detector.size(), 2U);
    EXPECT_EQ(frame.number, number);
    EXPECT_EQ(frame.pairs.size(), 1U);
    expect_exhaustive(detector.detect(), {&a, &b});
  }
}

TEST(Staleness, a_vertex_without_a_face_is_refused_in_every_frame_in_which_it_is_not_finite) {
  auto a = potato(6);
  const auto b = potato(6, 2);
  const auto v = a.add_vertex(Point(0, 0, 0));
  Exact_detector detector(exact_mode);
  add_all(detector, {&a, &b});
  for (int frame = 0; frame < 3; ++frame) {
    a.point(v) = Point(0, not_a_number, 0);
    EXPECT_NE(refusal([&] { detector.detect(); }).find("vertex " + std::to_string(v) + " of object 0"),
              std::string::npos);
    a.point(v) = Point(0, 0, 0);
    expect_exhaustive(detector.detect(), {&a, &b});
  }
}

}  // namespace
}  // namespace lodestone
