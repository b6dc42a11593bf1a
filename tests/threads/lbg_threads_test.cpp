// SPDX-License-Identifier: GPL-3.0-or-later
// Any number of threads, either search and every instruction set give the same bits: sums are formed chunk by chunk.
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "lodestone/partition/lbg.h"
#include "lodestone/partition/nearest_code_vector.h"
#include "partition/quantise_cases.h"
#include "support/instruction_sets.h"
#include "support/test_meshes.h"

namespace lodestone {
namespace {

/// Labels, distances and sums of one call, as in a Lloyd iteration.
void expect_same(const Assignment& a, const Assignment& b) {
  EXPECT_EQ(a.labels, b.labels);
  EXPECT_EQ(a.squared_distances, b.squared_distances);
  EXPECT_EQ(a.cell_sizes, b.cell_sizes);
  EXPECT_TRUE(same_bits(a.cell_sums, b.cell_sums));
}

TEST(Quantise, gives_the_same_bits_on_any_number_of_threads) {
  for (const std::size_t count : {1, 2, 7, 8, 9, 300, 4096, 4097, 20001})
    for (const Eigen::Index components : {3, 6, 10})
      for (const std::size_t cells : {1, 2, 11, 64})
        for (const auto split : {Split::principal_axis, Split::multiplicative}) {
          SCOPED_TRACE(testing::Message() << "M = " << count << ", k = " << components << ", N = " << cells);
          const auto vectors = seeded_vectors(count, components, count);
          const auto alone = quantise(vectors, cells, {.split_rule = split, .threads = 1});
          for (const std::size_t threads : {2, 3, 0}) {
            const auto shared = quantise(vectors, cells, {.split_rule = split, .threads = threads});
            expect_same(shared, alone);
            EXPECT_EQ(shared.distance_evaluations, alone.distance_evaluations);
          }
        }
}

TEST(Quantise, gives_the_same_bits_with_either_search_where_chunks_are_many) {
  for (const std::size_t count : {4097, 30003})
    for (const std::size_t cells : {2, 40}) {
      const auto vectors = seeded_vectors(count, 6, count);
      const auto plain = quantise(vectors, cells, {.search = Nearest_search::plain});
      for (const std::size_t threads : {1, 2}) {
        expect_same(quantise(vectors, cells, {.threads = threads}), plain);
        expect_same(quantise(vectors, cells, {.search = Nearest_search::plain, .threads = threads}), plain);
      }
    }
}

TEST(Quantise, re_seeds_empty_cells_in_the_same_way_on_any_number_of_threads) {
  // Symmetric around the origin: the published split leaves one of each pair of code vectors empty.
  Feature_vectors vectors = seeded_vectors(20000, 3, 1);
  vectors.bottomRows(10000) = -vectors.topRows(10000);
  const Lbg_options options{.split_rule = Split::multiplicative};
  auto threaded = options;
  threaded.threads = 2;
  for (const std::size_t cells : {2, 9, 33})
    expect_same(quantise(vectors, cells, threaded), quantise(vectors, cells, options));
}

TEST(Assignment, has_the_same_sums_from_either_search_and_any_number_of_workers) {
  const auto vectors = seeded_vectors(25003, 6, 2);
  for (const Eigen::Index cells : {1, 5, 200}) {
    const Feature_vectors codes = vectors.topRows(cells);
    Assignment plain;
    assign_plain(vectors, codes, plain);
    for (const std::size_t threads : {1, 2, 3}) {
      Workers workers(threads);
      Assignment shared_plain, bounded;
      assign_plain(vectors, codes, shared_plain, workers);
      expect_same(shared_plain, plain);
      Bounded_assignment search(vectors, workers);
      for (int call = 0; call < 2; ++call) {
        search.assign(codes, bounded);
        expect_same(bounded, plain);
      }
    }
  }
}

TEST(Assignment, adds_every_vector_exactly_once) {
  for (const std::size_t count : {1, 4095, 4096, 4097, 12289}) {
    const auto vectors = seeded_vectors(count, 3, count);
    const Feature_vectors codes = seeded_vectors(9, 3, 3);
    Assignment assignment;
    assign_plain(vectors, codes, assignment);
    Feature_vectors sums = Feature_vectors::Zero(9, 3);
    std::vector<std::uint64_t> sizes(9, 0);
    for (std::size_t v = 0; v < count; ++v) {
      sums.row(assignment.labels[v]) += vectors.row(static_cast<Eigen::Index>(v));
      ++sizes[assignment.labels[v]];
    }
    EXPECT_EQ(assignment.cell_sizes, sizes);
    EXPECT_LT((assignment.cell_sums - sums).cwiseAbs().maxCoeff(), 1e-12 * static_cast<double>(count));
  }
}

TEST(Quantise, gives_the_same_bits_on_every_instruction_set) {
  for (const Eigen::Index components : {3, 6, 7, 10}) {
    const auto vectors = seeded_vectors(9003, components, 5);
    const auto plain = quantise(vectors, 100, {.search = Nearest_search::plain});
    for_instruction_sets([&] { expect_same(quantise(vectors, 100, {.threads = 2}), plain); });
  }
}

TEST(Bounded_assignment, follows_vectors_that_are_reordered) {
  auto vectors = seeded_vectors(9001, 6, 4);
  const Feature_vectors codes = vectors.topRows(30);
  Bounded_assignment search(vectors);
  Assignment bounded, plain;
  search.assign(codes, bounded);
  vectors.colwise().reverseInPlace();
  search.reload();
  search.assign(codes, bounded);
  assign_plain(vectors, codes, plain);
  expect_same(bounded, plain);
}

TEST(Chunk_size, is_at_most_64_whole_blocks_and_no_more_than_the_vectors) {
  for (const std::size_t vectors : {1U, 4096U, 4097U, 262144U, 262145U, 10000000U})
    for (const std::size_t cells : {1U, 256U, 5000U, 100000U}) {
      const auto size = chunk_size(vectors, cells);
      const auto chunks = (vectors + size - 1) / size;
      EXPECT_EQ(size % 8, 0U);
      EXPECT_LE(chunks, 64U);
      EXPECT_TRUE(chunks == 1 || (chunks - 1) * cells <= vectors);
    }
}

TEST(Lbg, gives_the_same_labels_on_any_number_of_threads) {
  const auto mesh = potato(40);
  const Mesh_numbering<Surface_mesh> numbering(mesh);
  const auto vectors = feature_vectors(read_positions(numbering, mesh.points()), numbering.corners());
  ASSERT_GT(vectors.rows(), 4096);
  expect_same(quantise(vectors, 50, {.threads = 2}), quantise(vectors, 50));
}

}  // namespace
}  // namespace lodestone
