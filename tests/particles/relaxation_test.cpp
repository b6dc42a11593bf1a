// SPDX-License-Identifier: GPL-3.0-or-later
#include "lodestone/particles/relaxation.h"

#include <gtest/gtest.h>

#include <deque>
#include <random>
#include <set>

#include "support/count_allocations.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

struct Reader {
  const std::vector<Eigen::Vector3d>* points = nullptr;
  std::size_t* reads = nullptr;  ///< counted if not null
  Eigen::Vector3d operator()(std::uint32_t vertex) const {
    if (reads != nullptr) ++*reads;
    return (*points)[vertex];
  }
};

/// One object with everything that a walk needs. Not movable, since it refers to itself.
struct Walker {
  std::vector<Eigen::Vector3d> points;
  Region_steps steps;
  Particles particles;
  Reader reader{&points};

  Walker(std::vector<Eigen::Vector3d> positions, const std::vector<Corners>& faces,
         const std::vector<Region_index>& labels, std::vector<std::uint32_t> at, std::size_t hop_limit = 100,
         double effective_radius = 1000)
      : points(std::move(positions)), steps(vertex_graph(std::uint32_t(points.size()), faces), labels) {
    particles.at = std::move(at);
    particles.hop_limit = hop_limit;
    particles.effective_radius = effective_radius;
    read();
  }
  Walker(const Walker&) = delete;
  Walker& operator=(const Walker&) = delete;

  void read() {
    particles.positions.clear();
    for (const auto v : particles.at) particles.positions.push_back(points[v]);
  }
};

/// A particle that cannot move.
struct Post : Walker {
  explicit Post(const Eigen::Vector3d& place, double effective_radius = 1000)
      : Walker({place, place, place}, {{0, 1, 2}}, {0, 1, 2}, {0}, 0, effective_radius) {}
};

std::vector<Eigen::Vector3d> grid_points(std::uint32_t columns, std::uint32_t rows) {
  std::vector<Eigen::Vector3d> points;
  for (std::uint32_t y = 0; y < rows; ++y)
    for (std::uint32_t x = 0; x < columns; ++x) points.emplace_back(x, y, 0);
  return points;
}

/// A particle at vertex `at` of a grid that is a single region.
struct Grid_walker : Walker {
  Grid_walker(std::uint32_t columns, std::uint32_t rows, std::uint32_t at, std::size_t hop_limit = 100)
      : Walker(grid_points(columns, rows), grid_faces(columns, rows),
               std::vector<Region_index>(std::size_t{columns} * rows, 0), {at}, hop_limit) {}
};

Relaxation relax_alone(std::span<const Walking_object<Reader>> objects, Relaxation_scratch& scratch) {
  return relax(objects, scratch);
}

/// Relaxes objects that all feel each other.
using Relax = Relaxation (*)(std::span<const Walking_object<Reader>>, Relaxation_scratch&);
Relaxation relax_all(const std::vector<Walker*>& walkers, bool siblings_repel = false, Relax run = relax_alone) {
  std::vector<std::vector<std::uint32_t>> near(walkers.size());
  std::vector<Walking_object<Reader>> objects;
  std::vector<std::size_t> counts;
  for (std::uint32_t o = 0; o < walkers.size(); ++o) {
    for (std::uint32_t other = 0; other < walkers.size(); ++other)
      if (other != o) near[o].push_back(other);
    objects.push_back({.particles = &walkers[o]->particles,
                       .steps = &walkers[o]->steps,
                       .reader = &walkers[o]->reader,
                       .opponents = near[o],
                       .siblings_repel = siblings_repel});
    counts.push_back(walkers[o]->particles.at.size());
  }
  Relaxation_scratch scratch;
  scratch.reserve(counts);
  return run(std::span<const Walking_object<Reader>>(objects), scratch);
}

std::vector<Walker*> pointers(std::deque<Walker>& walkers) {
  std::vector<Walker*> result;
  for (auto& walker : walkers) result.push_back(&walker);
  return result;
}

using At = std::vector<std::uint32_t>;

TEST(Relax, a_particle_steps_to_the_neighbour_with_the_largest_force) {
  Grid_walker walker(5, 3, 5, 1);
  Post post({10, 1, 0});
  const auto result = relax_all({&walker, &post});
  EXPECT_EQ(walker.particles.at, At{6});
  EXPECT_EQ(walker.particles.positions[0], Eigen::Vector3d(1, 1, 0));
  EXPECT_EQ(result.moves, 1U);
  EXPECT_EQ(post.particles.at, At{0});
}

TEST(Relax, walks_until_it_rests) {
  Grid_walker walker(5, 3, 5);
  Post post({10, 1, 0});
  const auto result = relax_all({&walker, &post});
  EXPECT_EQ(walker.particles.at, At{9});
  EXPECT_EQ(result.moves, 4U);
  EXPECT_EQ(result.iterations, 5U);  // the last one, in which nothing moves
  EXPECT_TRUE(result.relaxed);
}

TEST(Relax, sizes_a_scratch_that_has_no_room_or_that_of_others) {
  Relaxation_scratch scratch;
  for (const std::uint32_t columns : {5U, 9U, 3U}) {
    Grid_walker walker(columns, 3, columns);
    Post post({10, 1, 0}), other({11, 1, 0});
    const std::vector<std::uint32_t> near{1};
    std::vector<Walking_object<Reader>> objects;
    for (Walker* each : {static_cast<Walker*>(&walker), static_cast<Walker*>(&post), static_cast<Walker*>(&other)})
      objects.push_back(
          {.particles = &each->particles,
           .steps = &each->steps,
           .reader = &each->reader,
           .opponents = each == &walker ? std::span<const std::uint32_t>(near) : std::span<const std::uint32_t>()});
    if (columns == 9) objects.pop_back();
    relax(std::span<const Walking_object<Reader>>(objects), scratch);
    EXPECT_EQ(walker.particles.at, At{2 * columns - 1});
  }
}

TEST(Relax, counts_from_the_start_of_each_call) {
  Relaxation_scratch scratch;
  const std::vector<std::uint32_t> near{1};
  std::vector<std::size_t> read, iterations;
  for (int call = 0; call < 3; ++call) {
    Grid_walker walker(5, 3, 5);
    Post post({10, 1, 0});
    const std::vector<Walking_object<Reader>> objects{
        {.particles = &walker.particles, .steps = &walker.steps, .reader = &walker.reader, .opponents = near},
        {.particles = &post.particles, .steps = &post.steps, .reader = &post.reader, .opponents = {}}};
    read.push_back(relax(std::span<const Walking_object<Reader>>(objects), scratch).vertices_read);
    iterations.push_back(scratch.iterations[0]);
  }
  EXPECT_GT(read[0], 0U);
  EXPECT_EQ(read, std::vector<std::size_t>(3, read[0]));
  EXPECT_EQ(iterations, std::vector<std::size_t>(3, 5));
}

TEST(Relax, goes_the_same_way_step_by_step) {
  Grid_walker at_once(8, 6, 0), in_steps(8, 6, 0, 1);
  Post post({9, 4.4, 0}, 1000), step_post({9, 4.4, 0}, 1000);
  relax_all({&at_once, &post});
  std::size_t steps = 0;
  while (relax_all({&in_steps, &step_post}).moves > 0) ++steps;
  EXPECT_EQ(in_steps.particles.at, at_once.particles.at);
  EXPECT_GT(steps, 3U);
}

TEST(Relax, r_max_bounds_the_iterations) {
  for (const std::size_t limit : {1, 2, 4}) {
    Grid_walker walker(8, 2, 0, limit);
    Post post({20, 0, 0});
    const auto result = relax_all({&walker, &post});
    EXPECT_EQ(result.iterations, limit);
    EXPECT_EQ(walker.particles.at, At{static_cast<std::uint32_t>(limit)});
    EXPECT_FALSE(result.relaxed);
  }
}

TEST(Relax, r_max_is_the_largest_of_the_objects) {
  Grid_walker walker(8, 2, 0, 1);
  Post post({20, 0, 0});
  post.particles.hop_limit = 3;
  EXPECT_EQ(relax_all({&walker, &post}).iterations, 3U);
  EXPECT_EQ(walker.particles.at, At{3});
}

TEST(Relax, stops_at_a_local_maximum_of_the_force) {
  // Of two posts over a row of vertices, the near one keeps a particle, though the other could be reached by a longer
  // walk.
  Grid_walker walker(9, 2, 2);
  Post left({1, 0, 0.5}), right({8, 0, 0.1});
  relax_all({&walker, &left, &right});
  EXPECT_EQ(walker.particles.at, At{1});
}

TEST(Relax, forces_of_several_particles_add_up) {
  // Vertex 1 is nearest to one post; at vertex 2 two others, each a little farther, pull more: 1 against 2 / 1.44.
  Walker walker({{0, 0, 0}, {-10, 0, 0}, {10, 0, 0}}, {{0, 1, 2}}, {0, 0, 0}, {0});
  Post a({-11, 0, 0}), b({10, 1.2, 0}), c({10, -1.2, 0});
  relax_all({&walker, &a, &b, &c});
  EXPECT_EQ(walker.particles.at, At{2});
}

TEST(Relax, ties_go_to_the_lowest_vertex_index) {
  for (const std::uint32_t start : {0U, 2U}) {
    Walker walker({{0, 0, 0}, {1, 1, 0}, {1, -1, 0}}, {{0, 1, 2}}, {0, 0, 0}, {start});
    Post post({3, 0, 0});
    relax_all({&walker, &post});
    EXPECT_EQ(walker.particles.at, At{1}) << start;
  }
}

TEST(Relax, without_force_a_particle_stays) {
  Walker walker({{0, 0, 0}, {1, 1, 0}, {1, -1, 0}}, {{0, 1, 2}}, {0, 0, 0}, {2}, 100, 5);
  Post post({9, 0, 0}, 5);
  const auto result = relax_all({&walker, &post});
  EXPECT_EQ(walker.particles.at, At{2});
  EXPECT_EQ(result.moves, 0U);
  EXPECT_TRUE(result.relaxed);
}

TEST(Relax, a_force_is_felt_up_to_the_larger_effective_radius_of_the_two_objects) {
  for (const auto& [own, others, moves] : {std::tuple{10.0, 1.0, true}, {1.0, 10.0, true}, {1.0, 1.0, false}}) {
    Walker walker({{0, 0, 0}, {1, 0, 0}, {1, -1, 0}}, {{0, 1, 2}}, {0, 0, 0}, {0}, 100, own);
    Post post({9, 0, 0}, others);
    relax_all({&walker, &post});
    EXPECT_EQ(walker.particles.at, (moves ? At{1} : At{0}));
  }
}

TEST(Relax, at_distance_0_a_particle_stays) {
  // Vertex 1 coincides with 2: a tie, if the particle compared its neighbours.
  Walker walker({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}, {{0, 1, 2}}, {0, 0, 0}, {2});
  Post post({1, 0, 0});
  EXPECT_EQ(relax_all({&walker, &post}).moves, 0U);
  EXPECT_EQ(walker.particles.at, At{2});
}

TEST(Relax, a_particle_steps_to_distance_0) {
  Walker walker({{0, 0, 0}, {1, 0, 0}, {5, 0, 0}}, {{0, 1, 2}}, {0, 0, 0}, {0});
  Post post({1, 0, 0});
  relax_all({&walker, &post});
  EXPECT_EQ(walker.particles.at, At{1});
}

TEST(Relax, all_particles_read_the_positions_before_the_iteration) {
  // With the other's old position a goes to its vertex 1, with its new one to 2.
  for (const bool a_first : {true, false}) {
    Walker a({{0, 0, 0}, {1, 1, 0}, {1, -1, 0}}, {{0, 1, 2}}, {0, 0, 0}, {0}, 1);
    Walker b({{3, 1, 0}, {2, -1, 0}, {90, 90, 0}}, {{0, 1, 2}}, {0, 0, 0}, {0}, 1);
    relax_all(a_first ? std::vector<Walker*>{&a, &b} : std::vector<Walker*>{&b, &a});
    EXPECT_EQ(a.particles.at, At{1});
    EXPECT_EQ(b.particles.at, At{1});
  }
}

/// Twenty particles on triangles side by side, of which the first `movers` can take one step towards x = 1000.
Relaxation relax_twenty(std::size_t movers) {
  std::vector<Eigen::Vector3d> points;
  std::vector<Corners> faces;
  std::vector<Region_index> labels;
  At at;
  for (std::uint32_t i = 0; i < 20; ++i) {
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      points.emplace_back(corner == 1 ? 1 : 0, i, corner == 2 ? 1 : 0);
      labels.push_back(i < movers ? 3 * i : 3 * i + corner);
    }
    faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    at.push_back(3 * i);
  }
  Walker walker(points, faces, labels, at, 100, 1e6);
  Post post({1000, 10, 0});
  return relax_all({&walker, &post});
}

TEST(Relax, is_relaxed_when_fewer_than_a_tenth_of_the_particles_moved) {
  EXPECT_EQ(relax_twenty(0).iterations, 1U);
  const auto one = relax_twenty(1);
  EXPECT_EQ(one.iterations, 1U);
  EXPECT_EQ(one.moves, 1U);
  EXPECT_TRUE(one.relaxed);
  const auto two = relax_twenty(2);
  EXPECT_EQ(two.iterations, 2U);
  EXPECT_EQ(two.moves, 2U);
  EXPECT_TRUE(two.relaxed);
}

TEST(Relax, a_particle_never_leaves_its_region) {
  const auto points = grid_points(12, 12);
  std::vector<Region_index> labels;
  for (std::uint32_t v = 0; v < 144; ++v) labels.push_back(v / 12 / 4 * 3 + v % 12 / 4);
  At at;
  for (std::uint32_t region = 0; region < 9; ++region) at.push_back(region / 3 * 48 + region % 3 * 4 + 13);
  Walker walker(points, grid_faces(12, 12), labels, at);
  for (const auto& place : {Eigen::Vector3d(20, 3, 1), {-9, 20, 0}, {5, 5, 0.1}, {0, 0, -3}}) {
    Post post(place);
    relax_all({&walker, &post});
    for (Region_index region = 0; region < 9; ++region) EXPECT_EQ(labels[walker.particles.at[region]], region);
  }
}

TEST(Relax, an_object_without_near_objects_is_not_relaxed) {
  Grid_walker walker(5, 3, 5), alone(5, 3, 5);
  Post post({10, 1, 0});
  const std::vector<std::uint32_t> feels_post{2}, feels_walker{0};
  std::vector<Walking_object<Reader>> objects;
  for (Walker* w : {static_cast<Walker*>(&walker), static_cast<Walker*>(&alone), static_cast<Walker*>(&post)})
    objects.push_back({.particles = &w->particles, .steps = &w->steps, .reader = &w->reader, .opponents = {}});
  objects[0].opponents = feels_post;
  objects[2].opponents = feels_walker;
  Relaxation_scratch scratch;
  scratch.reserve(std::vector<std::size_t>{1, 1, 1});
  relax(std::span<const Walking_object<Reader>>(objects), scratch);
  EXPECT_EQ(walker.particles.at, At{9});
  EXPECT_EQ(alone.particles.at, At{5});
}

TEST(Relax, siblings_repel_each_other_if_requested) {
  // Two particles in the middle of a row, and a post so far away that they feel only each other.
  for (const bool repel : {false, true}) {
    Walker walker(grid_points(7, 2), grid_faces(7, 2), std::vector<Region_index>(14, 0), {2, 3}, 1);
    Post post({2.5, 1e4, 0}, 1e5);
    relax_all({&walker, &post}, repel);
    // Pushed, the right one takes the diagonal; drawn by the post both go up.
    if (repel) {
      EXPECT_EQ(walker.particles.at, (At{1, 11}));
    } else {
      for (const auto v : walker.particles.at) EXPECT_GE(v, 7U);
    }
  }
}

TEST(Relax, a_particle_that_has_arrived_stays_also_where_a_sibling_has) {
  Walker walker(grid_points(7, 2), grid_faces(7, 2), std::vector<Region_index>(14, 0), {3, 3}, 1);
  Post post(walker.points[3], 1e5);
  relax_all({&walker, &post}, true);
  EXPECT_EQ(walker.particles.at, (At{3, 3}));
}

TEST(Relax, allocates_nothing_after_the_first_call) {
  Grid_walker one(30, 30, 0, 30), other(30, 30, 899, 30);
  const std::vector<std::uint32_t> feels_other{1}, feels_one{0};
  const std::vector<Walking_object<Reader>> objects{
      {.particles = &one.particles, .steps = &one.steps, .reader = &one.reader, .opponents = feels_other},
      {.particles = &other.particles, .steps = &other.steps, .reader = &other.reader, .opponents = feels_one}};
  Relaxation_scratch scratch;
  scratch.reserve(std::vector<std::size_t>{1, 1});
  const std::span<const Walking_object<Reader>> span(objects);
  ASSERT_GT(relax(span, scratch).moves, 0U);
  for (const std::uint32_t start : {29U, 870U, 450U}) {
    one.particles.at[0] = start;
    one.particles.positions[0] = one.points[start];
    const std::size_t before = allocations;
    const auto result = relax(span, scratch);
    EXPECT_EQ(allocations, before);
    EXPECT_GT(result.moves, 0U);
  }
}

/// Relaxation in which every particle compares its steps in every iteration.
template <class Reader_type>
Relaxation relax_without_rest(std::span<const Walking_object<Reader_type>> objects, Relaxation_scratch& scratch) {
  Relaxation result;
  std::size_t limit = 1;
  for (const auto& object : objects) limit = std::max(limit, object.particles->hop_limit);
  for (result.relaxed = false; !result.relaxed && result.iterations < limit; ++result.iterations) {
    scratch.start();
    result.relaxed = true;
    for (std::size_t o = 0; o < objects.size(); ++o) {
      const std::size_t moving = internal::choose_steps(objects, o, scratch);
      result.moves += moving;
      std::set<std::uint32_t> walking;
      for (std::uint32_t p = 0; p < objects[o].particles->at.size(); ++p)
        if (!objects[o].pulls) walking.insert(p);
      for (const Pull& pull : objects[o].pulls.value_or(std::span<const Pull>())) walking.insert(pull.particle);
      result.relaxed &= moving == 0 || 10 * moving < walking.size();
    }
    for (std::size_t o = 0; o < objects.size(); ++o) internal::take_steps(*objects[o].particles, o, scratch);
  }
  return result;
}

/// Spheres near each other, with particles spread over each.
std::deque<Walker> crowd(std::uint64_t seed, double effective_radius) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(0, 4);
  std::deque<Walker> walkers;
  for (int o = 0; o < 6; ++o) {
    const Surface_mesh mesh = sphere(8, 1, {place(random), place(random), place(random)});
    std::vector<Eigen::Vector3d> points;
    for (const auto v : mesh.vertices()) points.push_back(coordinates(mesh.point(v)));
    std::vector<std::uint32_t> at;
    for (int p = 0; p < 12; ++p) at.push_back(static_cast<std::uint32_t>(random() % points.size()));
    const std::vector<Region_index> labels(points.size(), 0);
    walkers.emplace_back(points, Mesh_numbering<Surface_mesh>(mesh).corners(), labels, at, 40, effective_radius);
  }
  return walkers;
}

TEST(Relaxation, leaves_particles_at_rest_alone_and_ends_as_if_it_did_not) {
  std::size_t iterations = 0, unrelaxed = 0;
  for (const bool siblings_repel : {false, true})
    for (const double reach : {0.5, 1.5, 1000.0})
      for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        auto resting = crowd(seed, reach), plain = crowd(seed, reach);
        const Relaxation found = relax_all(pointers(resting), siblings_repel);
        const Relaxation expected = relax_all(pointers(plain), siblings_repel, relax_without_rest<Reader>);
        EXPECT_EQ(found.iterations, expected.iterations);
        EXPECT_EQ(found.moves, expected.moves);
        EXPECT_EQ(found.relaxed, expected.relaxed);
        for (std::size_t o = 0; o < resting.size(); ++o) {
          EXPECT_EQ(resting[o].particles.at, plain[o].particles.at);
          EXPECT_EQ(resting[o].particles.positions, plain[o].particles.positions);
        }
        iterations += found.iterations;
        unrelaxed += found.relaxed ? 0 : 1;
      }
  EXPECT_GT(iterations, 300U);
  EXPECT_GT(unrelaxed, 5U);
}

TEST(Relaxation, compares_the_steps_of_a_particle_at_rest_once) {
  // The first two follow each other along a line of ten hops; the last two rest beside each other, far away.
  Grid_walker a(11, 2, 0), b(11, 2, 0);
  for (auto& point : b.points) point.z() = 3;
  b.particles.at = {10}, b.read();
  Post c({500, 0, 0}, 1), d({500, 0.5, 0}, 1);
  a.particles.effective_radius = b.particles.effective_radius = 100;
  std::size_t reads = 0;
  d.reader.reads = &reads;
  const Relaxation relaxation = relax_all({&a, &b, &c, &d});
  EXPECT_GE(relaxation.iterations, 4U);
  // Once to compare them, once to measure how far they reach.
  EXPECT_LE(reads, 2 * d.steps.from(0).size());
}

/// Objects with edges of different lengths, whose forces reach differently far.
std::deque<Walker> uneven_crowd(std::uint64_t seed, double reach) {
  auto walkers = crowd(seed, reach);
  for (std::size_t o = 0; o < walkers.size(); ++o) {
    for (auto& point : walkers[o].points) point.z() *= point.z() * point.z() / 4;
    walkers[o].particles.effective_radius = reach * static_cast<double>(1 + o % 3);
    walkers[o].read();
  }
  return walkers;
}

TEST(Relaxation, leaves_particles_at_rest_alone_where_forces_reach_differently_far_and_steps_differ_in_length) {
  std::size_t moves = 0;
  for (const bool siblings_repel : {false, true})
    for (const double reach : {0.3, 0.6, 1.2})
      for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        auto resting = uneven_crowd(seed, reach), plain = uneven_crowd(seed, reach);
        const Relaxation found = relax_all(pointers(resting), siblings_repel);
        const Relaxation expected = relax_all(pointers(plain), siblings_repel, relax_without_rest<Reader>);
        EXPECT_EQ(found.iterations, expected.iterations);
        EXPECT_EQ(found.moves, expected.moves);
        for (std::size_t o = 0; o < resting.size(); ++o) EXPECT_EQ(resting[o].particles.at, plain[o].particles.at);
        moves += found.moves;
      }
  EXPECT_GT(moves, 1000U);
}

/// Relaxes objects of whose particles every n-th feels one particle of each other object.
Relaxation relax_pulled(std::deque<Walker>& walkers, std::uint32_t n, Relax run) {
  const auto count = static_cast<std::uint32_t>(walkers.size());
  std::vector<std::vector<std::uint32_t>> near(count);
  std::vector<std::vector<Pull>> pulls(count);
  std::vector<Walking_object<Reader>> objects;
  std::vector<std::size_t> counts;
  for (std::uint32_t o = 0; o < count; ++o) {
    const auto particles = static_cast<std::uint32_t>(walkers[o].particles.at.size());
    for (std::uint32_t p = 0; p < particles; p += n)
      for (std::uint32_t other = 0; other < count; ++other)
        if (other != o) pulls[o].push_back({.particle = p, .object = other, .by = (5 * p + o) % particles});
    for (std::uint32_t other = 0; other < count; ++other)
      if (other != o) near[o].push_back(other);
    objects.push_back({.particles = &walkers[o].particles,
                       .steps = &walkers[o].steps,
                       .reader = &walkers[o].reader,
                       .opponents = near[o],
                       .pulls = std::span<const Pull>(pulls[o])});
    counts.push_back(particles);
  }
  Relaxation_scratch scratch;
  scratch.reserve(counts);
  return run(std::span<const Walking_object<Reader>>(objects), scratch);
}

TEST(Relaxation, leaves_particles_that_are_pulled_alone_and_ends_as_if_it_did_not) {
  for (const std::uint32_t n : {1U, 5U}) {
    std::size_t moves = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      auto resting = crowd(seed, 1), plain = crowd(seed, 1);
      const Relaxation found = relax_pulled(resting, n, relax_alone);
      const Relaxation expected = relax_pulled(plain, n, relax_without_rest<Reader>);
      EXPECT_EQ(found.iterations, expected.iterations);
      EXPECT_EQ(found.moves, expected.moves);
      for (std::size_t o = 0; o < resting.size(); ++o) EXPECT_EQ(resting[o].particles.at, plain[o].particles.at);
      moves += found.moves;
    }
    EXPECT_GT(n * moves, 1000U);  // an n-th of the particles walks
  }
}

TEST(Relaxation, goes_on_while_a_tenth_of_those_move_that_are_pulled) {
  // Of 40 particles in a row, each in a column of its own, three are drawn upwards.
  constexpr std::uint32_t columns = 40, rows = 6;
  std::vector<Region_index> labels;
  std::vector<std::uint32_t> at;
  for (std::uint32_t v = 0; v < columns * rows; ++v) labels.push_back(static_cast<Region_index>(v % columns));
  for (std::uint32_t p = 0; p < columns; ++p) at.push_back(p);
  Walker row(grid_points(columns, rows), grid_faces(columns, rows), labels, at, 20);
  Post post({20, 1000, 0});
  const std::vector<std::uint32_t> feels_post{1}, feels_row{0};
  const std::vector<Pull> pulls{{2, 1, 0}, {20, 1, 0}, {39, 1, 0}}, none;
  const std::vector<Walking_object<Reader>> objects{{.particles = &row.particles,
                                                     .steps = &row.steps,
                                                     .reader = &row.reader,
                                                     .opponents = feels_post,
                                                     .pulls = pulls},
                                                    {.particles = &post.particles,
                                                     .steps = &post.steps,
                                                     .reader = &post.reader,
                                                     .opponents = feels_row,
                                                     .pulls = none}};
  Relaxation_scratch scratch;
  scratch.reserve(std::vector<std::size_t>{columns, 1});
  const Relaxation result = relax(std::span<const Walking_object<Reader>>(objects), scratch);
  EXPECT_TRUE(result.relaxed);
  EXPECT_EQ(result.moves, 3 * (rows - 1));
  EXPECT_EQ(result.iterations, rows);
  for (const std::uint32_t p : {2U, 20U, 39U}) EXPECT_EQ(row.particles.at[p], p + (rows - 1) * columns);
}

}  // namespace
}  // namespace lodestone
