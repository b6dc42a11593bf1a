// SPDX-License-Identifier: GPL-3.0-or-later
// What every model of Computed_points guarantees: each function gives a vertex the same bits. Lists have no vertex
// twice, as the concept demands.
#include "lodestone/mesh/computed_points.h"

#include <bit>
#include <cmath>
#include <future>
#include <memory>
#include <numeric>

#include "contract/mesh_types.h"
#include "lodestone/io/motion/animation.h"
#include "lodestone/io/motion/computed_motion.h"
#include "lodestone/io/motion/deformed_points.h"
#include "lodestone/mesh/skinned_points.h"
#include "support/instruction_sets.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

/// Between -1 and 1; some are zeros whose sign can get lost.
std::vector<double> numbers_of(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<double> numbers(count);
  for (double& x : numbers) x = random() % 16 == 0 ? -0.0 : std::uniform_real_distribution<double>(-1, 1)(random);
  return numbers;
}
using Vertex_list = std::vector<std::uint32_t>;
Vertex_list vertices_below(std::uint32_t vertices) {
  Vertex_list list(vertices);
  std::iota(list.begin(), list.end(), 0U);
  return list;
}
std::vector<Point> rest_points(std::uint32_t vertices) {
  std::vector<Point> points;
  for (const auto v : vertices_below(vertices)) points.emplace_back(std::sin(v), std::cos(v * v), v % 7);
  return points;
}

/// Targets move all vertices, every fifth, the last one.
Morphed_points morphed_of(std::uint32_t vertices) {
  std::vector<Morph_target> targets(3);
  for (std::uint32_t v = 0; v < vertices; v += 5) targets[1].vertices.push_back(v);
  targets[2].vertices = {vertices - 1};
  targets[0].offsets = numbers_of(3 * vertices, 2);
  for (const std::size_t i : {1, 2}) targets[i].offsets = numbers_of(3 * targets[i].vertices.size(), 2 + i);
  return Morphed_points(numbers_of(3 * vertices, 1), targets);
}
/// Vertices follow one to some of five joints, some of them twice.
Skinned_points skinned_of(Morphed_points shape) {
  std::mt19937 random(7);
  Joint_influences influences;
  for (std::uint32_t v = 0, end = 0; v < shape.vertex_count(); ++v) {
    for (; influences.begin.back() == end || random() % 4 > 0; ++end) {
      influences.joints.push_back(static_cast<std::uint32_t>(random() % 5));
      influences.weights.push_back(0.1 + static_cast<double>(random() % 7));
    }
    influences.begin.push_back(end);
  }
  return {std::move(shape), influences, 5};
}

struct Morphed_case {
  Morphed_points points;
  explicit Morphed_case(std::uint32_t vertices) : points(morphed_of(vertices)) {}
  void pose(unsigned number) { points.set_weights(numbers_of(3, number)); }
  void pose_badly() { points.set_weights(std::vector<double>{1, 2, std::nan("")}); }
};
template <bool morphed>
struct Skinned_case {
  Skinned_points points;
  explicit Skinned_case(std::uint32_t vertices)
      : points(skinned_of(morphed ? morphed_of(vertices) : Morphed_points(numbers_of(3 * vertices, 1)))) {}
  void pose(unsigned number) {
    std::uint64_t seed = 10 * std::uint64_t{number};
    std::vector<Eigen::Affine3d> joints(5);
    for (auto& joint : joints) joint.affine() = Eigen::Matrix<double, 3, 4>(numbers_of(12, ++seed).data());
    points.set_joints(joints);
    if (morphed) points.set_weights(numbers_of(3, number));
  }
  void pose_badly() { points.set_joints(std::vector(4, Eigen::Affine3d::Identity())); }
};
const std::vector<Deformation> all_moves{Wobble{}, Bend{}, Twist{}, Inflate{}, Spin{}};
struct Deformed_case {
  Deformed_points points;
  explicit Deformed_case(std::uint32_t vertices) : points(rest_points(vertices), all_moves) {}
  void pose(unsigned number) { points.set_frame(1.5 * number); }
  void pose_badly() { points.set_frame(-1); }
};
struct Source_case : Deformed_case {
  Computed_source<Deformed_points> points{Deformed_case::points};
  using Deformed_case::Deformed_case;
};

/// A Computed_motion. There is no `pose_badly`: a frame that is refused leaves it in no pose.
template <auto make>
struct Motion_case {
  std::unique_ptr<Computed_motion> motion;
  Computed_motion& points = *motion;
  explicit Motion_case(std::uint32_t vertices) : motion(make(vertices)) {}
  void pose(unsigned number) { points.set_frame(number); }
};
auto still_motion(std::uint32_t vertices) {
  return deform(rest_points(vertices), {}).computed(vertices_below(vertices));
}
auto placed_motion(std::uint32_t vertices) {
  auto motion = deform(rest_points(vertices), all_moves).computed(vertices_below(vertices));
  return held(placed(std::move(motion), {0, -2, 0.1, 3, 1, 0, 0.5, 4, 0, 0, 3, 5}), 100);
}
auto file_motion(std::uint32_t vertices) {
  return read_animation(LODESTONE_DATA "/characters/hand.glb").motion.computed(vertices_below(vertices));
}

/// The bits of 3 V coordinates after `write` has written some of them, and of what lies around them.
std::vector<std::uint64_t> written(const auto& points, const auto& write) {
  const std::size_t around = 8, size = 3 * std::size_t{points.vertex_count()};
  std::vector<double> memory(size + 2 * around, 0x1.badp-77);
  write(std::span(memory).subspan(around, size));
  std::vector<std::uint64_t> bits;
  for (const double x : memory) bits.push_back(std::bit_cast<std::uint64_t>(x));
  return bits;
}
auto at_once(const auto& points) {
  return written(points, [&](auto to) { points.pose_all(to); });
}
auto as_a_list(const auto& points, const Vertex_list& list) {
  return written(points, [&](auto to) { points.pose(list, to); });
}
auto one_by_one(const auto& points, const Vertex_list& list) {
  return written(points, [&](auto to) {
    for (const auto v : list) Eigen::Map<Eigen::Vector3d>(to.data() + 3 * std::size_t{v}) = points(v);
  });
}

template <class Case>
struct Computed_points_contract : testing::Test {};
using Still_case = Motion_case<still_motion>;
using Computed_cases = testing::Types<Morphed_case, Skinned_case<false>, Skinned_case<true>, Deformed_case, Source_case,
                                      Still_case, Motion_case<placed_motion>, Motion_case<file_motion>>;
TYPED_TEST_SUITE(Computed_points_contract, Computed_cases);

TYPED_TEST(Computed_points_contract, every_function_gives_a_vertex_the_same_bits_and_writes_nothing_else) {
  for (const std::uint32_t vertices : {1U, 2U, 3U, 64U, 65U, 200U}) {
    TypeParam model(vertices);
    const auto& points = model.points;
    static_assert(Computed_points<std::remove_cvref_t<decltype(points)>>);
    ASSERT_EQ(points.vertex_count(), vertices);
    std::mt19937_64 random(vertices);
    const std::uint32_t last = vertices - 1;
    auto mixed = vertices_below(vertices);
    for (unsigned number = 0; number < 4; ++number) {
      SCOPED_TRACE(testing::Message() << vertices << " vertices, pose " << number);
      model.pose(number);
      std::ranges::shuffle(mixed, random);
      const auto truth = at_once(points);
      const Vertex_list half(mixed.begin(), mixed.begin() + vertices / 2);
      std::vector<Vertex_list> lists{vertices_below(vertices), mixed, half, {}, {0}, {last}};
      if (last > 0) lists.push_back({last, 0});
      for_instruction_sets([&] {
        EXPECT_EQ(at_once(points), truth);
        EXPECT_EQ(one_by_one(points, mixed), truth);
        for (const auto& list : lists) EXPECT_EQ(as_a_list(points, list), one_by_one(points, list));
      });
    }
  }
}

TYPED_TEST(Computed_points_contract, several_threads_read_the_same_bits_and_change_nothing) {
  TypeParam model(200);
  model.pose(1);
  const auto& points = model.points;
  const auto truth = at_once(points);
  const std::uint64_t number = points.pose_number();
  const auto read = [&] { return at_once(points) == truth && as_a_list(points, vertices_below(200)) == truth; };
  auto one = std::async(std::launch::async, read), other = std::async(std::launch::async, read);
  EXPECT_TRUE(one.get() && other.get());
  EXPECT_EQ(one_by_one(points, vertices_below(200)), truth);
  EXPECT_EQ(points.pose_number(), number);
}

TYPED_TEST(Computed_points_contract, a_new_pose_has_a_greater_number_and_its_own_positions) {
  constexpr bool stands = std::is_same_v<TypeParam, Still_case>;  // has one pose
  TypeParam model(200);
  std::vector<std::vector<std::uint64_t>> seen;
  std::uint64_t number = model.points.pose_number();
  EXPECT_GT(number, 0U);
  for (const unsigned pose : {3U, 1U, 2U, 3U}) {
    model.pose(pose);
    EXPECT_TRUE(stands || model.points.pose_number() > number);
    number = model.points.pose_number();
    seen.push_back(at_once(model.points));
  }
  EXPECT_EQ(seen[3], seen[0]);  // whatever has been in between
  EXPECT_TRUE(stands || (seen[0] != seen[1] && seen[1] != seen[2]));
}

TYPED_TEST(Computed_points_contract, a_pose_that_is_refused_changes_nothing) {
  if constexpr (requires(TypeParam & model) { model.pose_badly(); }) {
    TypeParam model(65);
    model.pose(1);
    const auto before = at_once(model.points);
    const auto number = model.points.pose_number();
    EXPECT_THROW(model.pose_badly(), Bad_argument);
    EXPECT_EQ(at_once(model.points), before);
    EXPECT_EQ(model.points.pose_number(), number);
  } else {
    GTEST_SKIP() << "a motion whose frame is refused is in no pose";
  }
}

TYPED_TEST(Computed_points_contract, an_assignment_raises_both_numbers) {
  if constexpr (requires(TypeParam & model) { model.points.shape_number(); }) {
    TypeParam model(65), other(65);
    model.pose(1), other.pose(2);
    const auto number = model.points.pose_number(), shape = model.points.shape_number();
    const auto assigned = at_once(other.points);
    model.points = std::move(other.points);
    EXPECT_EQ(at_once(model.points), assigned);
    EXPECT_GT(model.points.pose_number(), number);
    EXPECT_GT(model.points.shape_number(), shape);
  } else {
    GTEST_SKIP() << "motions and sources are not assigned to";
  }
}

template <class Mesh, class Points>
void expect_mapped(const Surface_mesh& shape, const Points& points, const Points& fewer) {
  const auto mesh = converted<Mesh>(shape);
  const auto map = point_map(mesh, points);
  const Mesh_numbering<Mesh> numbering(mesh);
  Coordinate_reader<Mesh, std::remove_const_t<decltype(map)>> reader(map), lacking(point_map(mesh, fewer));
  const Coordinates read = reader.read(numbering);
  ASSERT_EQ(read.size(), 3 * std::size_t{numbering.vertex_count()});
  std::uint32_t index = 0;
  for (const auto v : vertices(mesh)) {
    ASSERT_EQ(map.index(v), index);
    const Eigen::Vector3d truth = points(index++);
    ASSERT_EQ(get(map, v), Point(truth.x(), truth.y(), truth.z()));
    ASSERT_EQ(Eigen::Map<const Eigen::Vector3d>(read.data() + 3 * std::size_t{numbering.index(v)}), truth);
  }
  EXPECT_THROW(lacking.read(numbering), Bad_argument);
}

TYPED_TEST(Computed_points_contract, a_point_map_of_any_mesh_gives_the_positions_of_its_vertices) {
  const Surface_mesh shape = potato(3);
  const auto vertices = static_cast<std::uint32_t>(shape.number_of_vertices());
  TypeParam model(vertices + 1), fewer(vertices - 1);  // more points than vertices do no harm
  model.pose(2);
  expect_mapped<Surface_mesh>(shape, model.points, fewer.points);
  expect_mapped<Polyhedron>(shape, model.points, fewer.points);
  expect_mapped<Open_mesh>(shape, model.points, fewer.points);
  expect_mapped<Cell_complex>(shape, model.points, fewer.points);
}

}  // namespace
}  // namespace lodestone
